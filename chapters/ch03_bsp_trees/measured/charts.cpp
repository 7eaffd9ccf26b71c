#include "chapters/ch03_bsp_trees/measured/outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace space::ch03 {
namespace {

/// A line of one value over the polygons, with its slope.
template <class Value>
Series line(const std::vector<Growth>& growth, std::string_view scene, std::string_view method,
            const Value& value) {
    const Growth& g = growth_of(growth, scene, method);
    const Series series =
        series_along(fmt::format("{}, {}", scene, method), g.points, &TreePoint::polygons, value);
    return slope(g, value) ? with_slope(series) : series;
}

/// Zero has no place on a logarithmic axis: "none" is drawn here, below everything counted.
constexpr double none = 0.1;

}  // namespace

Chart fragments_chart(const std::vector<Growth>& growth) {
    Chart chart{
        .title = "Fragments against the number of polygons, by scene and choice of splitters",
        .x_label = "polygons",
        .y_label = "fragments per polygon",
        .log_x = true,
        .log_y = true,
        .series = {}};
    const auto per_polygon = [](const TreePoint& p) { return p.per_polygon(); };
    for (const auto& [scene, method] : {std::pair{"big triangles", "first"},
                                        {"big triangles", "weighted"},
                                        {"soup", "first"},
                                        {"soup", "weighted"},
                                        {"teapot", "first"},
                                        {"teapot", "weighted"}})
        chart.series.push_back(line(growth, scene, method, per_polygon));
    return chart;
}

Chart build_chart(const std::vector<Growth>& growth) {
    Chart chart{
        .title = "Build time against the number of polygons, by scene and choice of splitters",
        .x_label = "polygons",
        .y_label = "build time in ms",
        .log_x = true,
        .log_y = true,
        .series = {}};
    const auto build = [](const TreePoint& p) { return p.build_ms; };
    for (const auto& [scene, method] : {std::pair{"big triangles", "weighted"},
                                        {"icosphere", "weighted"},
                                        {"icosphere", "free"},
                                        {"soup", "weighted"},
                                        {"teapot", "weighted"},
                                        {"teapot", "first"}})
        chart.series.push_back(line(growth, scene, method, build));
    return chart;
}

Chart grades_chart(const std::vector<GradePoint>& grades) {
    Chart chart{.title = "Four grades of care: build time against rays that slip between fragments",
                .x_label = "build time, thick float = 1",
                .y_label = "slipped per million rays; 0.1 stands for none",
                .log_y = true,
                .kind = ChartKind::points,
                .series = {}};
    for (std::size_t grade = 0; grade < grade_names.size(); ++grade) {
        Series series{.name = std::string(grade_names[grade]), .x = {}, .y = {}};
        for (std::size_t i = 0; i < grades.size(); i += grade_names.size()) {
            const GradePoint& point = grades[i + grade];
            series.x.push_back(point.build_ms / grades[i].build_ms);
            series.y.push_back(std::max(point.slipped_per_million(), none));
            series.labels.push_back(point.scene);
        }
        chart.series.push_back(series);
    }
    return chart;
}

Chart rays_chart(const std::vector<Growth>& growth) {
    Chart chart{
        .title = "Nodes and tests per ray against the number of polygons, beside naive tracing",
        .x_label = "polygons",
        .y_label = "per ray",
        .log_x = true,
        .log_y = true,
        .series = {}};
    const auto nodes = [](const TreePoint& p) { return p.nodes_per_ray(); };
    const auto tests = [](const TreePoint& p) { return p.tests_per_ray(); };
    const auto add = [&](const char* name, const char* scene, const char* method,
                         const auto& value) {
        chart.series.push_back(line(growth, scene, method, value));
        chart.series.back().name = name;
    };
    add("naive: tests", "soup", "weighted", [](const TreePoint& p) { return double(p.polygons); });
    add("nodes, icosphere", "icosphere", "weighted", nodes);
    add("icosphere, free", "icosphere", "free", nodes);
    add("nodes, soup", "soup", "weighted", nodes);
    add("nodes, teapot", "teapot", "weighted", nodes);
    add("tests, soup", "soup", "weighted", tests);
    return chart;
}

}  // namespace space::ch03
