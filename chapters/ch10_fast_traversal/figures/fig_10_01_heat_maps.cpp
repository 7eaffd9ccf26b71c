// What each pixel's ray does in a binary tree and in wide ones.

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch10_fast_traversal/collapse.hpp"
#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/wide_walk.hpp"
#include "common/accelerator.hpp"
#include "common/parallel.hpp"
#include "common/program/heat.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

constexpr int map_width = 312, map_height = 234;

/// What one ray did: steps that wait for each other. Tests are of triangles, or of blocks of four.
struct PixelSteps {
    std::uint64_t nodes = 0, tests = 0;
};

/// Those of all pixels.
struct StepMap {
    std::string name;
    std::vector<PixelSteps> steps;

    double mean(std::uint64_t PixelSteps::*of) const {
        double sum = 0.0;
        for (const PixelSteps& pixel : steps) sum += static_cast<double>(pixel.*of);
        return sum / static_cast<double>(steps.size());
    }
};

template <class Trace>
StepMap map_of(std::string name, const Camera& camera, unsigned threads, const Trace& trace) {
    const PixelGrid grid(camera, map_width, map_height);
    StepMap map{std::move(name), std::vector<PixelSteps>(std::size_t{map_width} * map_height)};
    parallel_for(map_height, threads, 1, [&](std::size_t y) {
        for (int x = 0; x < map_width; ++x)
            map.steps[y * map_width + static_cast<std::size_t>(x)] =
                trace(grid.ray(x, static_cast<int>(y)));
    });
    return map;
}

template <int N>
PixelSteps wide_steps(const WideTree<N>& tree, const Ray& ray) {
    TraversalCounts counts;
    PixelSteps steps;
    double limit = infinity;
    walk_wide_any(tree, ray, counts, [&](const TriangleBlock& block) {
        ++steps.tests;
        for (std::size_t lane = 0; lane < TriangleBlock::size && block.is_used(lane); ++lane)
            if (const auto hit = FilteredExact::intersect(ray, block.triangle(lane)))
                limit = std::min(limit, double{hit->t});
        return limit;
    });
    steps.nodes = counts.nodes_visited;
    return steps;
}

template <int N, class Builder>
StepMap wide_map(std::string name, std::span<const Triangle> triangles, const Camera& camera,
                 unsigned threads) {
    const auto tree =
        collapsed<N>(Builder::template build<3>(triangles, typename Builder::Config{}), triangles);
    return map_of(std::move(name), camera, threads,
                  [&](const Ray& ray) { return wide_steps(tree, ray); });
}

/// All that is more than `most` looks the same.
constexpr double most = 60;

Image picture(const StepMap& map) {
    Image image(map_width, map_height);
    for (int y = 0; y < map_height; ++y)
        for (int x = 0; x < map_width; ++x) {
            const PixelSteps& pixel = map.steps[static_cast<std::size_t>(y * map_width + x)];
            image.at(x, y) = heat(static_cast<double>(pixel.nodes + pixel.tests) / most);
        }
    return image;
}

void draw_scale(Svg& svg, double top) {
    constexpr double left = 60, length = 520;
    svg.picture(at(left, top), at(length, 16), heat_bar(), "scale");
    for (double count = 0; count <= most; count += 15) {
        const double x = left + length * count / most;
        svg.line(at(x, top + 16), at(x, top + 22), {.stroke = Ink::quiet});
        svg.text(at(x, top + 40), (count < most ? "" : "≥ ") + svg_number(count), {.size = 17});
    }
}

}  // namespace

Svg fig_10_01(const Options& options) {
    const Scene scene = make_scene("building");
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const auto binary = Bvh<BinnedBuilder>::build(triangles);
    const std::array maps{
        map_of("two children", scene.camera, options.threads,
               [&](const Ray& ray) {
                   TraversalCounts counts;
                   binary.closest_hit(ray, counts);
                   return PixelSteps{counts.nodes_visited, counts.triangles_tested};
               }),
        wide_map<4, BinnedBuilder>("four", triangles, scene.camera, options.threads),
        wide_map<8, BinnedBuilder>("eight", triangles, scene.camera, options.threads),
        wide_map<8, SpatialSplitBuilder>("eight, spatial splits", triangles, scene.camera,
                                         options.threads)};
    Svg svg("Nodes and tests for each pixel of a house, in a binary tree and in three wide ones",
            640, 2 * (map_height + 36) + 62);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const double left = 4 + static_cast<double>(i % 2) * (map_width + 8),
                     top = static_cast<double>(i / 2) * (map_height + 36);
        svg.text(at(left + 0.5 * map_width, top + 20),
                 fmt::format("{}: {:.1f} + {:.1f}", maps[i].name, maps[i].mean(&PixelSteps::nodes),
                             maps[i].mean(&PixelSteps::tests)),
                 {.size = 17});
        svg.picture(at(left, top + 28), at(map_width, map_height), picture(maps[i]),
                    fmt::format("map-{}", i + 1));
    }
    draw_scale(svg, 2 * (map_height + 36) + 10);
    return svg;
}

}  // namespace space::ch10
