#include "chapters/ch04_kd_trees/measured/outcome.hpp"

#include <fmt/format.h>

namespace space::ch04 {
namespace {

/// A growing scene's values by one rule, with their slope.
template <class Value>
Series line(const std::vector<Growth>& growth, std::string_view scene, std::string_view rule,
            const std::string& name, const Value& value) {
    for (const Growth& g : growth)
        if (g.front().scene == scene && g.front().rule == rule)
            return with_slope(series_along(name, g, &TreePoint::n, value));
    return {.name = name, .x = {}, .y = {}};
}

/// Zero has no place on a logarithmic axis: "none" is drawn here, below everything counted.
constexpr double none = 0.5;

}  // namespace

Chart rules_chart(const std::vector<TreePoint>& trees) {
    Chart chart{.title = "Build time against rays per second, by rule and scene",
                .x_label = "build time in µs per triangle",
                .y_label = "million rays per second",
                .log_x = true,
                .log_y = true,
                .kind = ChartKind::points,
                .series = {}};
    for (const std::string_view rule : rule_names) {
        Series series{.name = std::string(rule), .x = {}, .y = {}};
        for (const TreePoint& p : trees) {
            if (p.rule != rule) continue;
            series.x.push_back(1e3 * p.build_ms / double(p.n));
            series.y.push_back(1e-6 * p.rays_per_second());
        }
        chart.series.push_back(series);
    }
    return chart;
}

Chart care_chart(const std::vector<CarePoint>& care) {
    Chart chart{.title = "Time per ray against lost hits, by grade of care and scene",
                .x_label = "time per ray, with care = 1",
                .y_label = "lost hits per million aimed rays; below 1: none",
                .log_y = true,
                .kind = ChartKind::points,
                .series = {}};
    for (std::size_t grade = 0; grade < care_names.size(); ++grade) {
        Series series{.name = std::string(care_names[grade]), .x = {}, .y = {}};
        for (std::size_t i = 0; i < care.size(); i += care_names.size()) {
            const CarePoint &point = care[i + grade], &careful = care[i + care_names.size() - 1];
            series.x.push_back(point.trace_ms / careful.trace_ms);
            series.y.push_back(point.lost > 0 ? point.lost_per_million() : none);
        }
        chart.series.push_back(series);
    }
    return chart;
}

Chart rays_chart(const std::vector<Growth>& growth) {
    Chart chart{
        .title = "Nodes and tests per ray against the number of triangles, beside naive tracing",
        .x_label = "triangles",
        .y_label = "per ray",
        .log_x = true,
        .log_y = true,
        .series = {}};
    const auto nodes = [](const TreePoint& p) { return p.nodes_per_ray(); };
    const auto tests = [](const TreePoint& p) { return p.tests_per_ray(); };
    const auto add = [&](const char* scene, std::string_view rule, const std::string& name,
                         const auto& value) {
        chart.series.push_back(line(growth, scene, rule, name, value));
    };
    add("soup", "SAH", "naive: tests", [](const TreePoint& p) { return double(p.n); });
    add("soup", "SAH", "nodes, soup", nodes);
    add("icosphere", "SAH", "nodes, icosphere", nodes);
    add("soup", "SAH", "tests, soup", tests);
    add("icosphere", "SAH", "tests, icosphere", tests);
    add("icosphere", "middle", "tests, icosphere, middle", tests);
    return chart;
}

Chart build_chart(const std::vector<Growth>& growth) {
    Chart chart{.title = "Build time against the number of triangles, by rule",
                .x_label = "triangles",
                .y_label = "build time in ms",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const char* scene : {"soup", "teapot"})
        for (const std::string_view rule : {"SAH", "median", "middle"})
            chart.series.push_back(line(growth, scene, rule, fmt::format("{}, {}", scene, rule),
                                        [](const TreePoint& p) { return p.build_ms; }));
    return chart;
}

Chart points_chart(const std::vector<PointSet>& points) {
    Chart chart{.title = "Nodes and buckets that a search for the nearest point visits",
                .x_label = "points",
                .y_label = "visited per search",
                .log_x = true,
                .series = {}};
    for (const auto& [name, sets] : series_of(points))
        chart.series.push_back(series_along(
            name, sets, [](const PointSet* set) { return double(set->points); },
            [](const PointSet* set) { return visited(*set); }));
    return chart;
}

}  // namespace space::ch04
