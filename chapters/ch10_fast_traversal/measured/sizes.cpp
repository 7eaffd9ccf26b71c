#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch10_fast_traversal/compressed_bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/tracer.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"
#include "common/program/progress.hpp"

#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {

void measure_sizes(const Options& options, FastMeasurements& measured) {
    const FastEffort effort = fast_effort(options);
    Progress progress("sizes", effort.sizes.size());
    for (const std::string& name : effort.sizes) {
        const std::optional<TracedScene> scene =
            traced_scene(name, false, effort.width, effort.height, options);
        if (!scene) continue;
        std::vector<Tracer> all;
        {
            const BvhNodes<3> binary = QuickBuilder::build<3>(scene->triangles);
            all.push_back(our_tracer("wide", FastBvh<>::over(binary, scene->triangles)));
            all.push_back(
                our_tracer("compressed", CompressedBvh<>::over(binary, scene->triangles)));
        }
        all.push_back(our_tracer("binary", Bvh<BinnedBuilder>::build(scene->triangles)));
        if (effort.rounds > 0)
            for (Tracer& tracer : embree_tracers(scene->triangles, {embree_default}))
                all.push_back(std::move(tracer));
        for (const RayKind kind : {camera_kind, diffuse_kind}) {
            const std::vector<double> ns = ray_times(all, *scene, kind, effort.rounds);
            for (std::size_t i = 0; i < all.size(); ++i) {
                SizePoint point{.scene = name.substr(0, name.find(':')),
                                .structure = all[i].name,
                                .kind = kind,
                                .triangles = scene->triangles.size(),
                                .bytes = all[i].shape.bytes,
                                .rays = scene->ray_count(kind),
                                .ns = ns[i]};
                if (all[i].count) {
                    const TraversalCounts counts =
                        all[i].count(scene->rays[kind], ManyQuery::closest);
                    point.nodes = counts.nodes_visited;
                    point.tests = counts.triangles_tested;
                }
                measured.sizes.push_back(std::move(point));
            }
        }
        progress.step();
    }
}

}  // namespace space::ch10
