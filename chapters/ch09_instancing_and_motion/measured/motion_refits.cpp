#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"
#include "chapters/ch09_instancing_and_motion/deforming.hpp"
#include "chapters/ch09_instancing_and_motion/measured/motion.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <cstddef>
#include <functional>

namespace space::ch09 {
namespace {

/// Adds up what the builder bins.
struct BinnedReferences {
    std::uint64_t count = 0;
    void observe(const BvhChosen<3>& chosen) {
        if (chosen.cut) count += chosen.task.range.size();
    }
};

std::vector<std::string> refit_scenes(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {"icosphere:6", "soup:1000"};
        case Amount::quick:
            return {"icosphere:22", "soup:10000", "icosphere:71", "soup:100000"};
        case Amount::full:
            break;
    }
    return {"icosphere:22", "soup:10000",    "icosphere:71",
            "soup:100000",  "icosphere:224", "soup:1000000"};
}

/// One pass that has each leaf fetch its triangles, and so waits for each of them.
void refit_and_fetch(BvhNodes<3>& tree, std::vector<Triangle>& own,
                     std::span<const Triangle> moved) {
    refit_upwards(
        tree,
        [&](const BvhNode<3>& leaf) {
            Aabb box;
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                own[i] = moved[tree.references[i]];
                box.extend(box_if_finite<3>(own[i]));
            }
            return box;
        },
        [](std::uint32_t) {});
}

double ns_per_unit(const RefittedBvh<>& bvh, std::span<const Triangle> triangles) {
    const std::vector<Ray> rays = rays_from_around(triangles, 20'000, 5);
    TraversalCounts counts;
    for (const Ray& ray : rays) do_not_optimize(bvh.closest_hit(ray, counts));
    const std::function<void()> trace = [&] {
        for (const Ray& ray : rays) do_not_optimize(closest_hit(bvh, ray));
    };
    const double ms = interleaved_medians({&trace, 1}, 3).front();
    return 1e6 * ms /
           (MotionUnits::node * double(counts.nodes_visited) +
            MotionUnits::test * double(counts.triangles_tested));
}

void time_refits(RefitPoint& point, std::span<const Triangle> rest) {
    std::vector<Triangle> moved(rest.size());
    move_to(0.01, Scatter{}, rest, moved);
    RefittedBvh<> bvh = RefittedBvh<>::build(rest);
    point.ns_per_unit = ns_per_unit(bvh, rest);
    BvhNodes<3> two_passes = bvh.nodes(), fetched_between = bvh.nodes();
    std::vector<Triangle> own(two_passes.references.size());
    RefittedBvh<> turning = bvh;
    bool is_there = false;
    // Rotations have to be found anew each time: there and back.
    const auto rotate = [&] { turning.refit_and_rotate((is_there = !is_there) ? moved : rest); };
    const std::vector<std::function<void()>> runs{
        [&] { do_not_optimize(RefittedBvh<>::build(moved)); },
        [&] { do_not_optimize(RefittedBvh<MortonBuilder>::build(moved)); },
        [&] { refit<3>(two_passes, moved); },
        [&] { refit_and_fetch(fetched_between, own, moved); },
        [&] { bvh.refit(moved); },
        rotate};
    const std::vector<double> ms = interleaved_medians(runs, 5);
    point.build_ms = ms[0];
    point.morton_ms = ms[1];
    point.two_passes_ms = ms[2];
    point.fetched_between_ms = ms[3];
    point.refit_ms = ms[4];
    point.rotate_ms = ms[5];
}

}  // namespace

std::uint64_t binned_references(std::span<const Triangle> triangles) {
    BinnedReferences binned;
    BinnedBuilder::build<3>(triangles, {}, binned);
    return binned.count;
}

std::vector<RefitPoint> measure_refits(const Options& options) {
    const std::vector<std::string> scenes = refit_scenes(options);
    std::vector<RefitPoint> points;
    Progress progress("refits", scenes.size());
    for (const std::string& scene : scenes) {
        const std::vector<Triangle> rest = make_scene(scene, options.seed).mesh.triangles();
        points.push_back({.scene = scene,
                          .n = rest.size(),
                          .nodes = BinnedBuilder::build<3>(rest).size(),
                          .binned = binned_references(rest)});
        if (!options.small && !options.counts) time_refits(points.back(), rest);
        progress.step();
    }
    return points;
}

}  // namespace space::ch09
