// What each pixel's ray costs, in the published tree and in the one by areas.

#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/published_kd_tree.hpp"
#include "common/parallel.hpp"
#include "common/program/heat.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace space::ch04 {
namespace {

constexpr int width = 312, height = 234;

/// What each pixel's ray did.
template <class Tree>
std::vector<TraversalCounts> counts_of(const Tree& tree, const PixelGrid& grid, unsigned threads) {
    std::vector<TraversalCounts> counts(width * height);
    parallel_for(height, threads, 1, [&](std::size_t y) {
        for (int x = 0; x < width; ++x)
            tree.closest_hit(grid.ray(x, static_cast<int>(y)),
                             counts[y * width + static_cast<std::size_t>(x)]);
    });
    return counts;
}

/// One number of a tree, at each pixel.
struct Map {
    const char* of;
    std::vector<std::uint64_t> values = {};
    std::uint64_t largest() const { return *std::ranges::max_element(values); }
    double mean() const {
        double sum = 0.0;
        for (const std::uint64_t value : values) sum += static_cast<double>(value);
        return sum / static_cast<double>(values.size());
    }
};

std::array<Map, 2> maps_of(const std::vector<TraversalCounts>& counts) {
    std::array<Map, 2> maps{Map{"nodes visited"}, Map{"triangles tested"}};
    for (const TraversalCounts& pixel : counts) {
        maps[0].values.push_back(pixel.nodes_visited);
        maps[1].values.push_back(pixel.triangles_tested);
    }
    return maps;
}

/// A logarithmic scale from 1 on.
struct Scale {
    double decades;
    double share(double count) const { return count < 1.0 ? 0.0 : std::log10(count) / decades; }
};

Image picture(const Map& map, const Scale& scale) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = heat(scale.share(
                static_cast<double>(map.values[static_cast<std::size_t>(y * width + x)])));
    return image;
}

void draw_scale(Svg& svg, const Scale& scale, double top) {
    constexpr double left = 60, length = 520;
    svg.picture(at(left, top), at(length, 16), heat_bar(), "scale");
    for (int power = 0; power <= static_cast<int>(scale.decades); ++power) {
        const double x = left + length * power / scale.decades;
        svg.line(at(x, top + 16), at(x, top + 22), {.stroke = Ink::quiet});
        svg.text(at(x, top + 40), fmt::format("{}", std::lround(std::pow(10.0, power))),
                 {.size = 17});
    }
}

}  // namespace

Svg fig_04_01(const Options& options) {
    const Scene scene = make_scene("room:3");
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const PixelGrid grid(scene.camera, width, height);
    const std::array names{"as published", "by areas (SAH)"};
    const std::array maps{
        maps_of(counts_of(PublishedKdTree<>::build(triangles), grid, options.threads)),
        maps_of(counts_of(KdTree<>::build(triangles), grid, options.threads))};
    std::uint64_t largest = 1;
    for (const auto& pair : maps)
        for (const Map& map : pair) largest = std::max(largest, map.largest());
    const Scale scale{std::log10(static_cast<double>(largest))};

    Svg svg(
        "Nodes visited and triangles tested for each pixel of a room, in the published tree and in "
        "the one by surface areas",
        640, 2 * (height + 36) + 84);
    for (std::size_t row = 0; row < maps.size(); ++row)
        for (std::size_t i = 0; i < maps[row].size(); ++i) {
            const Map& map = maps[row][i];
            const double left = 4 + static_cast<double>(i) * (width + 8),
                         top = 24 + static_cast<double>(row) * (height + 36);
            if (row == 0) svg.text(at(left + 0.5 * width, 18), map.of, {.size = 18, .bold = true});
            svg.text(at(left + 0.5 * width, top + 20),
                     fmt::format("{}: {:.0f} a ray", names[row], map.mean()), {.size = 17});
            svg.picture(at(left, top + 28), at(width, height), picture(map, scale),
                        fmt::format("map-{}-{}", row + 1, i + 1));
        }
    draw_scale(svg, scale, 2 * (height + 36) + 34);
    return svg;
}

}  // namespace space::ch04
