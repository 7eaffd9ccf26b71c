#include "chapters/ch07_bounding_volume_hierarchies/bottom_up_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/any_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/measurements.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/ray_task.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "common/program/progress.hpp"

#include <fmt/format.h>

#include <utility>

namespace space::ch07 {
namespace {

struct Variant {
    std::string name;
    AnyBuilder::Config config;
};

std::vector<Variant> spatial_variants() {
    std::vector<Variant> all;
    for (const double growth : {1.0, 1.1, 1.3, 1.5, 2.0})
        all.push_back(
            {fmt::format("growth {:g}", growth), any<SpatialSplitBuilder>({.max_growth = growth})});
    all.push_back({"growth 1.3, not unsplit", any<SpatialSplitBuilder>({.unsplits = false})});
    return all;
}

std::vector<Variant> below_variants() {
    std::vector<Variant> all;
    for (const std::uint32_t radius : {1, 4, 16, 64})
        all.push_back({fmt::format("{}, radius {}", by_bottom_up, radius),
                       any<BottomUpBuilder>({.radius = radius})});
    for (const NamedBuilder& builder : builders())
        if (builder.name == by_bins || builder.name == by_morton || builder.name == by_optimiser ||
            builder.name == by_bsp)
            all.push_back({std::string(builder.name), builder.config});
    return all;
}

std::vector<VariantPoint> measure_variants(const std::vector<std::string>& scenes,
                                           const std::vector<Variant>& variants,
                                           const Options& options) {
    const Limits limit = limits(options);
    std::vector<VariantPoint> points;
    Progress progress("variants", scenes.size());
    for (const std::string& name : scenes) {
        const RayTask task(name, make_scene(name, options.seed, options.small), limit.width,
                           limit.height, 0, 1, options.seed);
        for (const Variant& variant : variants) {
            const auto tree = Bvh<AnyBuilder>::build(task.triangles, variant.config);
            TraversalCounts counts;
            trace(tree, task, diffuse_kind, counts);
            points.push_back({.scene = name,
                              .variant = variant.name,
                              .n = task.triangles.size(),
                              .references = tree.nodes().references.size(),
                              .cost = tree.nodes().sah_cost({}),
                              .rays = {.rays = task.rays[diffuse_kind].size(),
                                       .nodes = counts.nodes_visited,
                                       .tests = counts.triangles_tested}});
        }
        progress.step();
    }
    return points;
}

}  // namespace

std::vector<VariantPoint> measure_spatial(const Options& options) {
    return measure_variants({"slivers", "building:1"}, spatial_variants(), options);
}

std::vector<VariantPoint> measure_from_below(const Options& options) {
    return measure_variants({"soup", "stadium", "building:1"}, below_variants(), options);
}

}  // namespace space::ch07
