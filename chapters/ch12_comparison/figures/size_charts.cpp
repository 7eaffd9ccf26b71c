#include "chapters/ch12_comparison/figures/chart_parts.hpp"
#include "chapters/ch12_comparison/figures/comparison_charts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace space::ch12 {
namespace {

constexpr std::array<std::string_view, 3> growth_scenes{"soup", "scan", "tree"};
constexpr std::array<std::pair<std::string_view, Symbol>, 7> growth_structures{{
    {"naive", {Shape::star, Ink::ink, false, 6}},
    {"kd-sah", {Shape::square, Ink::green, false, 5}},
    {"octree-linear", {Shape::diamond, Ink::orange, false, 6}},
    {"bvh-binned", {Shape::circle, Ink::blue, false, 5}},
    {"bvh-parallel-morton", {Shape::circle, Ink::sky, true, 5}},
    {"fast", {Shape::triangle, Ink::vermillion, false, 5}},
    {"fast-hq", {Shape::triangle, Ink::purple, true, 5}},
}};

/// What stands along the left of the two columns.
struct GrowthColumn {
    std::string_view text;
    double (*value)(const ComparedRow& row);
};
constexpr std::array<GrowthColumn, 2> growth_columns{
    {{"build, ms", [](const ComparedRow& row) { return row.ready_ms(); }},
     {"ns per ray", [](const ComparedRow& row) { return row.mean_ns(); }}}};

/// One structure over the sizes of one scene.
Series growth_series(const Comparison& comparison, std::string_view scene,
                     std::string_view structure, const GrowthColumn& column) {
    Series series{.name = std::string(structure), .x = {}, .y = {}};
    for (const Block block : sizes_of(comparison, scene))
        if (const ComparedRow* row = find(block, structure))
            if (const double value = column.value(*row); std::isfinite(value) && value > 0.0) {
                series.x.push_back(double(row->triangles));
                series.y.push_back(value);
                series.labels.push_back(row->spec + ", " + std::string(column.text));
            }
    return series;
}

/// All lines of one panel. Naive tracing is built in no time, which is left out.
std::vector<Series> growth_lines(const Comparison& comparison, std::string_view scene,
                                 const GrowthColumn& column) {
    std::vector<Series> lines;
    for (const auto& [name, symbol] : growth_structures) {
        const bool left_out = name == "naive" && &column == growth_columns.data();
        lines.push_back(left_out ? Series{.name = std::string(name), .x = {}, .y = {}}
                                 : growth_series(comparison, scene, name, column));
    }
    return lines;
}

Axis axis_of(const std::vector<std::vector<Series>>& panels, std::vector<double> Series::*values,
             std::size_t most_ticks) {
    double least = infinity, most = 0.0;
    for (const auto& panel : panels)
        for (const Series& series : panel)
            for (const double value : series.*values)
                least = std::min(least, value), most = std::max(most, value);
    return log_axis(least, most, most_ticks);
}

}  // namespace

Chart growth_chart(const Comparison& comparison) {
    std::array<std::vector<std::vector<Series>>, 2> columns;  // of them the scenes' panels
    for (std::size_t c = 0; c < columns.size(); ++c)
        for (const std::string_view scene : growth_scenes)
            columns[c].push_back(growth_lines(comparison, scene, growth_columns[c]));
    Chart chart{.title =
                    "The time of a build and of a ray against the number of triangles, in "
                    "three scenes",
                .x_label = "triangles",
                .y_label = "value",
                .log_x = true,
                .log_y = true,
                .series = {}};
    constexpr double width = 246, height = 190, row = 232, left = 66, step = 318;
    Svg& svg = chart.drawing.emplace(chart.title, 640, 152 + row * growth_scenes.size());
    std::vector<KeyEntry> key;
    for (const auto& [name, symbol] : growth_structures) key.push_back({name, symbol});
    const double top = draw_key(svg, 8, 0, 620, key) + 54;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const Axis x = axis_of(columns[c], &Series::x, 5), y = axis_of(columns[c], &Series::y, 6);
        svg.text(at(8 + step * double(c), top - 32), growth_columns[c].text,
                 {.anchor = Anchor::start, .size = 16});
        for (std::size_t s = 0; s < growth_scenes.size(); ++s) {
            const Panel panel{left + step * double(c), top + row * double(s), width, height, x, y};
            draw_panel(svg, panel,
                       {.title = growth_scenes[s], .x_ticks = s + 1 == growth_scenes.size()});
            for (std::size_t i = 0; i < columns[c][s].size(); ++i) {
                const Series& series = columns[c][s][i];
                std::vector<Point2> line;
                for (std::size_t k = 0; k < series.x.size(); ++k)
                    line.push_back(panel.place(series.x[k], series.y[k]));
                const Symbol& symbol = growth_structures[i].second;
                if (line.size() > 1) svg.polyline(line, {.stroke = symbol.ink});
                for (const Point2& point : line) draw_symbol(svg, point, symbol);
                if (!line.empty()) chart.series.push_back(series);
            }
        }
    }
    svg.text(at(345, top + row * growth_scenes.size() + 6), "triangles", {.size = 16});
    return chart;
}

}  // namespace space::ch12
