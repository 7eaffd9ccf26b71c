#include "chapters/ch06_quadtrees_and_octrees/measured/outcome.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <ranges>

namespace space::ch06 {
namespace {

/// The scenes in their order, each once.
std::vector<std::string> scenes_of(const std::vector<TreePoint>& trees) {
    std::vector<std::string> scenes;
    for (const TreePoint& p : trees)
        if (std::ranges::count(scenes, p.scene) == 0) scenes.push_back(p.scene);
    return scenes;
}

}  // namespace

Chart points_chart(const std::vector<PointTree>& points) {
    Chart chart{.title = "Cells of quadtrees and octrees of points against (d + 1) n",
                .x_label = "(d + 1) n",
                .y_label = "cells, with the empty ones",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const auto& [name, sets] : series_of(points)) {
        if (name.starts_with("pairs 2^-12") || name.starts_with("pairs 2^-16")) continue;
        chart.series.push_back(
            with_slope(series_along(name, sets, &PointTree::bound, &PointTree::cells)));
    }
    return chart;
}

Chart depths_chart(const std::vector<TreePoint>& depths) {
    Chart chart{.title = "Time of a ray against memory, for octrees with limits of depth",
                .x_label = "bytes per triangle",
                .y_label = "µs per ray",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string& scene : scenes_of(depths)) {
        Series series{.name = scene, .x = {}, .y = {}};
        for (const TreePoint& p : depths) {
            if (p.scene != scene) continue;
            series.x.push_back(p.bytes_per_triangle());
            series.y.push_back(1e3 * p.trace_ms / double(p.rays));
            series.labels.push_back(std::to_string(p.depth_limit));
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

Chart shapes_chart(const std::vector<TreePoint>& trees) {
    Chart chart{.title = "Depth and references per triangle of trees, by scene",
                .x_label = "scene",
                .y_label = "depth; references per triangle",
                .kind = ChartKind::bars,
                .series = {}};
    chart.categories = scenes_of(trees);
    const auto add = [&](std::string_view tree, std::string_view what, const auto& value) {
        chart.add_bars(fmt::format("{}: {}", tree, what), [&](const std::string& scene) {
            return double(std::invoke(value, tree_of(trees, scene, tree)));
        });
    };
    add(octree, "depth", &TreePoint::depth);
    add(sah, "depth", &TreePoint::depth);
    add(octree, "references", &TreePoint::per_triangle);
    add(sah, "references", &TreePoint::per_triangle);
    return chart;
}

Chart rays_chart(const std::vector<TreePoint>& trees) {
    Chart chart{.title = "Rays per second by tree and scene",
                .x_label = "scene",
                .y_label = "rays per second, SAH k-d tree = 1",
                .kind = ChartKind::bars,
                .series = {}};
    chart.categories = scenes_of(trees);
    for (const std::string_view name : {octree, plain_walk, pointers, kept, loose, linear})
        chart.add_bars(
            name, [&](const std::string& scene) { return speed_beside_sah(trees, scene, name); });
    return chart;
}

Chart build_chart(const std::vector<TreePoint>& growth) {
    Chart chart{.title = "Build time against the number of triangles",
                .x_label = "triangles",
                .y_label = "build time in ms",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string_view scene : {"soup", "stadium"})
        for (const std::string_view name : {sah, octree, linear}) {
            auto grown = growth | std::views::filter([&](const TreePoint& p) {
                             return p.scene == scene && p.tree == name;
                         });
            chart.series.push_back(with_slope(series_along(
                fmt::format("{}, {}", scene, name), grown, &TreePoint::n, &TreePoint::build_ms)));
        }
    return chart;
}

}  // namespace space::ch06
