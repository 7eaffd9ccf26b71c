#include "chapters/ch06_quadtrees_and_octrees/measured/outcome.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/series.hpp"

#include <fmt/format.h>

#include <algorithm>

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
        Series series{.name = name, .x = {}, .y = {}};
        for (const PointTree& p : sets) {
            series.x.push_back(p.bound());
            series.y.push_back(double(p.cells));
        }
        const auto cells = [](const PointTree& p) { return double(p.cells); };
        if (sets.size() > 1) series.note = fmt::format("slope {:.2f}", slope(sets, cells));
        chart.series.push_back(std::move(series));
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

Chart rays_chart(const std::vector<TreePoint>& trees) {
    Chart chart{.title = "Rays per second by tree and scene",
                .x_label = "scene",
                .y_label = "rays per second, SAH k-d tree = 1",
                .kind = ChartKind::bars,
                .series = {}};
    chart.categories = scenes_of(trees);
    for (const std::string_view name : {octree, plain_walk, pointers, kept, loose, linear}) {
        Series series{.name = std::string(name), .x = {}, .y = {}};
        for (const std::string& scene : chart.categories) {
            series.x.push_back(double(series.x.size()));
            series.y.push_back(speed_beside_sah(trees, scene, name));
        }
        chart.series.push_back(std::move(series));
    }
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
            Series series{.name = fmt::format("{}, {}", scene, name), .x = {}, .y = {}};
            for (const TreePoint& p : growth) {
                if (p.scene != scene || p.tree != name) continue;
                series.x.push_back(double(p.n));
                series.y.push_back(p.build_ms);
            }
            if (series.x.size() > 1)
                series.note = fmt::format("slope {:.2f}", log_log_slope(series.x, series.y));
            chart.series.push_back(std::move(series));
        }
    return chart;
}

}  // namespace space::ch06
