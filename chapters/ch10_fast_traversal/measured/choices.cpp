#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/optimised_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/tracer.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"

#include <fmt/format.h>

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

/// A tree by some choice.
struct Chosen {
    Tracer tracer;
    std::uint64_t nodes, blocks, bytes;
    double cost;
};
template <int N, class Builder>
Chosen chosen(std::string name, WideBvh<N, Builder> bvh) {
    Chosen one{.tracer = {},
               .nodes = bvh.tree().nodes.size(),
               .blocks = bvh.tree().blocks.size(),
               .bytes = bvh.tree().bytes(),
               .cost = bvh.tree().cost};
    one.tracer = our_tracer(std::move(name), std::move(bvh));
    return one;
}

/// Counts are of diffuse rays.
void compare(const TracedScene& scene, std::vector<Chosen> all, int rounds,
             std::vector<ChoicePoint>& points) {
    const std::size_t first = points.size();
    std::vector<Tracer> tracers;
    for (Chosen& one : all) {
        const TraversalCounts counts =
            one.tracer.count(scene.rays[diffuse_kind], ManyQuery::closest);
        points.push_back({.scene = scene.name,
                          .choice = one.tracer.name,
                          .triangles = scene.triangles.size(),
                          .nodes = one.nodes,
                          .blocks = one.blocks,
                          .bytes = one.bytes,
                          .rays = scene.ray_count(diffuse_kind),
                          .visits = counts.nodes_visited,
                          .tests = counts.triangles_tested,
                          .cost = one.cost});
        tracers.push_back(std::move(one.tracer));
    }
    for (const RayKind kind : {camera_kind, shadow_kind, diffuse_kind}) {
        const std::vector<double> ns = ray_times(tracers, scene, kind, rounds);
        for (std::size_t i = 0; i < ns.size(); ++i) points[first + i].ns[kind] = ns[i];
    }
}

}  // namespace

void measure_choices(const TracedScene& scene, const FastEffort& effort,
                     FastMeasurements& measured) {
    const BvhNodes<3> binary = QuickBuilder::build<3>(scene.triangles);
    const auto over = [&]<int N>(std::string name, std::integral_constant<int, N>,
                                 const CollapseConfig& collapse) {
        WideBvhConfig<QuickBuilder> config;
        config.collapse = collapse;
        return chosen<N, QuickBuilder>(
            std::move(name), WideBvh<N, QuickBuilder>::over(binary, scene.triangles, config));
    };
    constexpr std::integral_constant<int, 4> four;
    constexpr std::integral_constant<int, 8> eight;
    compare(scene, {over("four", four, {}), over("eight", eight, {})}, effort.rounds,
            measured.widths);
    std::vector<Chosen> leaves;
    for (const std::size_t size : {1, 2, 4, 8})
        leaves.push_back(over(fmt::format("at most {}", size), eight, {.max_leaf = size}));
    compare(scene, std::move(leaves), effort.rounds, measured.leaf_sizes);
    if (scene.triangles.size() > effort.most_high) return;
    const auto built = [&]<class Builder>(std::string name, std::type_identity<Builder>) {
        return chosen<8, Builder>(std::move(name), WideBvh<8, Builder>::build(scene.triangles));
    };
    compare(scene,
            {over("quick", eight, {}), built("binned", std::type_identity<BinnedBuilder>{}),
             built("sweep", std::type_identity<SweepBuilder>{}),
             built("spatial splits", std::type_identity<SpatialSplitBuilder>{}),
             built("optimised", std::type_identity<OptimisedBuilder>{}),
             built("high quality", std::type_identity<HighQualityBuilder>{})},
            effort.rounds, measured.high);
}

}  // namespace space::ch10
