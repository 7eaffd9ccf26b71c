#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/interleaved.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/tracer.hpp"
#include "chapters/ch10_fast_traversal/measured/wrong_hits.hpp"
#include "common/aimed_rays.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

template <int N, class Builder = BinnedBuilder>
WideBvh<N, Builder> wide_bvh(const BvhNodes<3>& binary, const TracedScene& scene,
                             InstructionSet set,
                             CollapseConfig::Way way = CollapseConfig::Way::least_cost) {
    typename WideBvh<N, Builder>::Config config;
    config.instructions = set;
    config.collapse.way = way;
    return WideBvh<N, Builder>::over(binary, scene.triangles, config);
}

/// The best tree, eight of its rays under way.
Tracer interleaved_tracer(std::string name, const FastBvh<>& tree) {
    const auto shared = std::make_shared<const FastBvh<>>(tree);
    constexpr unsigned together = 8;
    return {.name = std::move(name),
            .shape = shared->shape(),
            .trace =
                [shared](std::span<const Ray> rays, ManyQuery query) {
                    trace_interleaved(
                        *shared, rays, together, query,
                        [](std::size_t, const std::optional<Hit>& hit) { do_not_optimize(hit); });
                },
            .answers =
                [shared](std::span<const Ray> rays, ManyQuery query) {
                    Answers all(rays.size());
                    trace_interleaved(
                        *shared, rays, together, query,
                        [&](std::size_t i, const std::optional<Hit>& hit) { all[i] = hit; });
                    return all;
                }};
}

/// In the order in which they are climbed.
std::vector<Tracer> rungs(const TracedScene& scene, const FastEffort& effort) {
    const BvhNodes<3> binary = BinnedBuilder::build<3>(scene.triangles);
    std::vector<Tracer> all;
    all.push_back(our_tracer("binary, float test",
                             Bvh<BinnedBuilder, MollerTrumboreFloat>::build(scene.triangles)));
    all.push_back(our_tracer("binary", Bvh<BinnedBuilder>::build(scene.triangles)));
    all.push_back(our_tracer(
        "eight children, greedily",
        wide_bvh<8>(binary, scene, InstructionSet::scalar, CollapseConfig::Way::greedy)));
    all.push_back(
        our_tracer("eight, by least cost", wide_bvh<8>(binary, scene, InstructionSet::scalar)));
    // The kernels' names are those of what this processor has; a count does not hang on them.
    const std::vector<InstructionSet> usable = usable_instruction_sets();
    const auto has = [&](InstructionSet set) { return std::ranges::count(usable, set) > 0; };
    if (effort.rounds > 0) {
        for (const InstructionSet set : {InstructionSet::sse2, InstructionSet::avx2})
            if (has(set))
                all.push_back(our_tracer("four, " + std::string(name_of(set)),
                                         wide_bvh<4>(binary, scene, set)));
        for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
            if (has(set))
                all.push_back(our_tracer("eight, " + std::string(name_of(set)),
                                         wide_bvh<8>(binary, scene, set)));
    }
    const FastBvh<> best = FastBvh<>::build(scene.triangles);
    all.push_back(our_tracer("a tree for blocks of four", best));
    all.push_back(interleaved_tracer("eight rays interleaved", best));
    if (scene.triangles.size() <= effort.most_high)
        all.push_back(
            our_tracer("a better tree", WideBvh<8, SpatialSplitBuilder>::build(scene.triangles)));
    if (effort.rounds > 0)
        for (Tracer& tracer : embree_tracers(scene.triangles, {embree_default, embree_robust}))
            all.push_back(std::move(tracer));
    return all;
}

}  // namespace

void measure_ladder(const TracedScene& scene, const Options& options, FastMeasurements& measured) {
    const FastEffort effort = fast_effort(options);
    const std::vector<Tracer> all = rungs(scene, effort);
    const std::vector<Ray> aimed =
        rays_at_edges(scene.triangles, effort.aimed_rays / 5, options.seed);
    // The binary tree's answers are the naive loop's (chapter 7 proves it).
    const Answers wanted = all[1].answers(aimed, ManyQuery::closest);
    std::vector<std::uint64_t> wrong;
    for (const Tracer& tracer : all)
        wrong.push_back(wrong_hits(tracer.answers(aimed, ManyQuery::closest), wanted));
    for (const RayKind kind : {camera_kind, shadow_kind, diffuse_kind}) {
        const std::span<const Ray> rays = scene.rays[kind];
        if (rays.empty()) continue;
        const std::vector<double> ns = ray_times(all, scene, kind, effort.rounds);
        for (std::size_t i = 0; i < all.size(); ++i) {
            RungPoint point{.scene = scene.name,
                            .rung = all[i].name,
                            .kind = kind,
                            .triangles = scene.triangles.size(),
                            .bytes = all[i].shape.bytes,
                            .rays = rays.size(),
                            .ns = ns[i]};
            if (all[i].count) {
                const TraversalCounts counts = all[i].count(rays, query_of(kind));
                point.nodes = counts.nodes_visited;
                point.tests = counts.triangles_tested;
            }
            for (const WorkPoint& work : measured.work)
                if (work.scene == scene.name && work.kind == kind && work.structure == "wide")
                    point.bound_ns = work.bound_ns();
            point.aimed = aimed.size();
            point.wrong = wrong[i];
            measured.ladder.push_back(point);
        }
    }
}

}  // namespace space::ch10
