// A lattice that is twisted: what each pixel's ray costs, frame by frame, in trees that follow.

#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/measured/moving_scenes.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "common/parallel.hpp"
#include "common/program/heat.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace space::ch09 {
namespace {

constexpr int width = 152, height = 152;
/// Nodes; all that are more look the same.
constexpr double most = 160;
constexpr std::size_t frames = 60;
constexpr std::array<std::size_t, 4> shown{0, 20, 40, 60};

/// A picture, and the nodes that a ray visits on average.
struct Map {
    Image image{width, height};
    double mean = 0.0;
};

Map map_of(const RefittedBvh<>& bvh, const PixelGrid& grid, unsigned threads) {
    std::vector<TraversalCounts> counts(std::size_t{width} * height);
    parallel_for(height, threads, 1, [&](std::size_t y) {
        for (int x = 0; x < width; ++x)
            bvh.closest_hit(grid.ray(x, static_cast<int>(y)),
                            counts[y * width + static_cast<std::size_t>(x)]);
    });
    Map map;
    std::uint64_t sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto nodes = counts[static_cast<std::size_t>(y * width + x)].nodes_visited;
            sum += nodes;
            map.image.at(x, y) = heat(static_cast<double>(nodes) / most);
        }
    map.mean = static_cast<double>(sum) / static_cast<double>(counts.size());
    return map;
}

void draw_map(Svg& svg, const Map& map, std::size_t column, std::size_t row) {
    const double left = 4 + static_cast<double>(column) * (width + 8),
                 top = 52 + static_cast<double>(row) * (height + 58);
    svg.picture(at(left, top), at(width, height), map.image,
                fmt::format("map-{}-{}", row + 1, column + 1));
    svg.text(at(left + 0.5 * width, top + height + 22), fmt::format("{:.0f} nodes", map.mean),
             {.size = 17});
}

void draw_scale(Svg& svg, double top) {
    constexpr double left = 60, length = 520;
    svg.picture(at(left, top), at(length, 16), heat_bar(), "scale");
    for (double count = 0; count <= most; count += 40) {
        const double x = left + length * count / most;
        svg.line(at(x, top + 16), at(x, top + 22), {.stroke = Ink::quiet});
        svg.text(at(x, top + 40), (count < most ? "" : "≥ ") + svg_number(count), {.size = 17});
    }
}

}  // namespace

Svg fig_09_14(const Options& options) {
    const MovingScene moving = twist_scene("lattice");
    const PixelGrid grid(make_scene("lattice").camera, width, height);
    Svg svg("Nodes visited for each pixel of a lattice while it is twisted, in three trees", 648,
            52 + 3 * (height + 58) + 54);
    RefittedBvh<> follows = RefittedBvh<>::build(moving.at(0.0)), turns = follows;
    std::size_t column = 0;
    for (std::size_t frame = 0; frame <= frames; ++frame) {
        const auto moved = moving.at(double(frame) / double{frames});
        turns.refit_and_rotate(moved);
        if (frame != shown[column]) continue;
        follows.refit(moved);
        svg.text(at(4 + static_cast<double>(column) * (width + 8) + 0.5 * width, 20),
                 fmt::format("frame {}", frame), {.size = 18, .bold = true});
        draw_map(svg, map_of(RefittedBvh<>::build(moved), grid, options.threads), column, 0);
        draw_map(svg, map_of(follows, grid, options.threads), column, 1);
        draw_map(svg, map_of(turns, grid, options.threads), column, 2);
        ++column;
    }
    std::size_t row = 0;
    for (const char* const way : {"built anew", "refitted", "refitted, with rotations"})
        svg.text(at(4, 45 + static_cast<double>(row++) * (height + 58)), way,
                 {.anchor = Anchor::start, .size = 17});
    draw_scale(svg, 52 + 3 * (height + 58) + 6);
    return svg;
}

}  // namespace space::ch09
