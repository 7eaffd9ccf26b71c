// What each pixel's ray costs in the trees of four builders.

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/middle_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "common/parallel.hpp"
#include "common/program/heat.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace space::ch07 {
namespace {

constexpr int map_width = 312, map_height = 234;

/// What each pixel's ray did.
struct Map {
    const char* builder;
    std::vector<TraversalCounts> counts = {};

    double steps(int x, int y) const {
        const TraversalCounts& pixel = counts[static_cast<std::size_t>(y * map_width + x)];
        return static_cast<double>(pixel.nodes_visited + pixel.triangles_tested);
    }
    double mean(std::uint64_t TraversalCounts::*of) const {
        double sum = 0.0;
        for (const TraversalCounts& pixel : counts) sum += static_cast<double>(pixel.*of);
        return sum / static_cast<double>(counts.size());
    }
};

template <class Builder>
Map map_of(const char* name, const Scene& scene, unsigned threads) {
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const auto bvh = Bvh<Builder>::build(triangles);
    const PixelGrid grid(scene.camera, map_width, map_height);
    Map map{name, std::vector<TraversalCounts>(map_width * map_height)};
    parallel_for(map_height, threads, 1, [&](std::size_t y) {
        for (int x = 0; x < map_width; ++x)
            bvh.closest_hit(grid.ray(x, static_cast<int>(y)),
                            map.counts[y * map_width + static_cast<std::size_t>(x)]);
    });
    return map;
}

/// All that is more than `most` looks the same.
constexpr double most = 100;

Image picture(const Map& map) {
    Image image(map_width, map_height);
    for (int y = 0; y < map_height; ++y)
        for (int x = 0; x < map_width; ++x) image.at(x, y) = heat(map.steps(x, y) / most);
    return image;
}

void draw_scale(Svg& svg, double top) {
    constexpr double left = 60, length = 520;
    svg.picture(at(left, top), at(length, 16), heat_bar(), "scale");
    for (double count = 0; count <= most; count += 25) {
        const double x = left + length * count / most;
        svg.line(at(x, top + 16), at(x, top + 22), {.stroke = Ink::quiet});
        svg.text(at(x, top + 40), (count < most ? "" : "≥ ") + svg_number(count), {.size = 17});
    }
}

}  // namespace

Svg fig_07_01(const Options& options) {
    const Scene scene = make_scene("building");
    const std::array maps{
        map_of<MiddleBuilder>("cut in the middle", scene, options.threads),
        map_of<MedianBuilder>("halved by count", scene, options.threads),
        map_of<BinnedBuilder>("by surface areas", scene, options.threads),
        map_of<SpatialSplitBuilder>("with spatial splits", scene, options.threads)};
    Svg svg(
        "Nodes visited and triangles tested for each pixel of a house, in the trees of four "
        "builders",
        640, 2 * (map_height + 36) + 62);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const double left = 4 + static_cast<double>(i % 2) * (map_width + 8),
                     top = static_cast<double>(i / 2) * (map_height + 36);
        svg.text(at(left + 0.5 * map_width, top + 20),
                 fmt::format("{}: {:.0f} + {:.0f}", maps[i].builder,
                             maps[i].mean(&TraversalCounts::nodes_visited),
                             maps[i].mean(&TraversalCounts::triangles_tested)),
                 {.size = 17});
        svg.picture(at(left, top + 28), at(map_width, map_height), picture(maps[i]),
                    fmt::format("map-{}", i + 1));
    }
    draw_scale(svg, 2 * (map_height + 36) + 10);
    return svg;
}

}  // namespace space::ch07
