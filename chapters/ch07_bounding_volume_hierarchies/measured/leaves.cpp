#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/any_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/measurements.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/ray_task.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "common/program/progress.hpp"

#include <array>
#include <memory>
#include <utility>

namespace space::ch07 {
namespace {

LeafPoint count_leaves(const RayTask& task, std::string_view builder, double rule,
                       const Bvh<AnyBuilder>& tree) {
    LeafPoint point{.scene = task.scene,
                    .builder = builder,
                    .rule = rule,
                    .n = task.triangles.size(),
                    .nodes = tree.nodes().size(),
                    .rays = task.rays[diffuse_kind].size()};
    TraversalCounts counts;
    trace(tree, task, diffuse_kind, counts);
    point.tests = counts.triangles_tested;
    // The same walks once more: how many of the nodes are leaves?
    std::uint64_t leaves = 0;
    for (const Ray& ray : task.rays[diffuse_kind])
        nearest_found([&](const auto& found) {
            NoCounts none;
            double limit = infinity;
            walk_bvh(tree.nodes(), ray, none, [&](const BvhNode<3>& leaf) {
                ++leaves;
                for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                    const std::uint32_t triangle = tree.nodes().references[i];
                    auto hit = FilteredExact::intersect(ray, task.triangles[triangle]);
                    if (!hit) continue;
                    hit->triangle = triangle;
                    limit = found(*hit);
                }
                return limit;
            });
        });
    point.inner = counts.nodes_visited - leaves;
    return point;
}

std::vector<LeafPoint> measure_rules(const RayTask& task, const Options& options) {
    std::vector<LeafPoint> points;
    std::vector<std::function<void()>> traces;
    const auto add = [&](std::string_view builder, double rule, const AnyBuilder::Config& config) {
        const auto tree =
            std::make_shared<const Bvh<AnyBuilder>>(Bvh<AnyBuilder>::build(task.triangles, config));
        points.push_back(count_leaves(task, builder, rule, *tree));
        traces.push_back(runs(task, tree)[diffuse_kind]);
    };
    for (const std::size_t most : {1, 2, 4, 8, 16})
        add(by_median, double(most), any<MedianBuilder>({.max_leaf_size = most}));
    for (const double costs : {0.0, 0.5, 1.0, 2.25, 4.0, 8.0})
        add(by_bins, costs,
            any<BinnedBuilder>({.costs = {.traversal = costs}, .max_leaf_size = 64}));
    const int rounds = limits(options).rounds;
    if (rounds == 0) return points;
    const std::vector<double> medians = interleaved_medians(traces, rounds);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].ms = medians[i];
    return points;
}

}  // namespace

std::vector<LeafPoint> measure_leaves(const Options& options) {
    const Limits limit = limits(options);
    std::vector<std::string> scenes{"icosphere:22", "soup:10000", "building", "soup:200000"};
    if (options.small) scenes = {"soup:1000"};
    if (options.amount() == Amount::quick) scenes.pop_back();
    std::vector<LeafPoint> points;
    Progress progress("leaves", scenes.size());
    for (const std::string& name : scenes) {
        const RayTask task(name, make_scene(name, options.seed), limit.width, limit.height, 0, 1,
                           options.seed);
        for (LeafPoint& point : measure_rules(task, options)) points.push_back(std::move(point));
        progress.step();
    }
    return points;
}

}  // namespace space::ch07
