#include "chapters/ch12_comparison/figures/chart_parts.hpp"
#include "chapters/ch12_comparison/figures/comparison_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace space::ch12 {
namespace {

/// Those of ours that no other one beats in both, from left to right; less is better.
std::vector<std::size_t> front_of(const std::vector<const ComparedRow*>& rows, auto x, auto y) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (!rows[i]->is_peer) order.push_back(i);
    std::ranges::sort(order, {},
                      [&](std::size_t i) { return std::pair(x(*rows[i]), y(*rows[i])); });
    // A gain of a tenth may be the machine's mood.
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || y(*rows[i]) < 0.9 * y(*rows[front.back()])) front.push_back(i);
    return front;
}

constexpr std::array<std::string_view, 6> pareto_scenes{"scan",    "building", "soup",
                                                        "stadium", "blanket",  "soup_uneven"};
constexpr double pareto_left = 66, pareto_width = 250, pareto_step = 322, pareto_height = 236,
                 pareto_row = 276;

/// Naive tracing is far above all others where scenes are large, and BSP trees are not asked there:
/// frames and keys are without them.
constexpr std::array<std::string_view, 5> large_families{"k-d", "octrees", "BVH", "wide BVH",
                                                         "others' code"};
bool is_large_scale(const ComparedRow& row) {
    return std::ranges::find(large_families, family_of(row).name) != large_families.end();
}

bool is_shown(const ComparedRow& row) {
    return row.stands() && is_large_scale(row) && row.ready_ms() > 0.0 &&
           std::isfinite(row.mean_ns());
}

double ready(const ComparedRow& row) {
    return row.ready_ms();
}
double trace_cost(const ComparedRow& row) {
    return row.mean_ns();
}

struct Ranges {
    double least_x = infinity, most_x = 0.0, least_y = infinity, most_y = 0.0;
    void add(double x, double y) {
        least_x = std::min(least_x, x), most_x = std::max(most_x, x);
        least_y = std::min(least_y, y), most_y = std::max(most_y, y);
    }
    void add(Block block) {
        for (const ComparedRow& row : block)
            if (is_shown(row)) add(ready(row), trace_cost(row));
    }
};

void draw_pareto(Svg& svg, const Panel& panel, Block block, const PanelTexts& texts) {
    draw_panel(svg, panel, texts);
    std::vector<const ComparedRow*> rows;
    for (const ComparedRow& row : block)
        if (is_shown(row)) rows.push_back(&row);
    const std::vector<std::size_t> front = front_of(rows, ready, trace_cost);
    const auto place = [&](const ComparedRow& row) {
        return panel.place(ready(row), trace_cost(row));
    };
    Labels labels({at(panel.left + 2, panel.top), at(panel.right() + 8, panel.bottom() - 2)});
    std::vector<Point2> joined;
    for (const std::size_t i : front) {
        const Point2 here = place(*rows[i]);
        if (!joined.empty()) {
            const Point2 corner(here.x, joined.back().y);
            labels.keep_free_along(joined.back(), corner);
            labels.keep_free_along(corner, here);
            joined.push_back(corner);
        }
        joined.push_back(here);
    }
    if (joined.size() > 1) svg.polyline(joined, {.stroke = Ink::quiet});
    for (const ComparedRow* row : rows) {
        draw_symbol(svg, place(*row), family_of(*row).symbol);
        labels.keep_free(place(*row), 7.0);
    }
    // Of steps that gain little one is named.
    double named_cost = infinity;
    for (const std::size_t i : front) {
        if (i != front.back() && trace_cost(*rows[i]) > 0.8 * named_cost) continue;
        named_cost = trace_cost(*rows[i]);
        labels.draw(svg, place(*rows[i]), rows[i]->structure, {.size = 16, .halo = true});
    }
}

/// Each structure as a series over the blocks, for the data beside the drawing.
std::vector<Series> series_over(std::span<const Block> shown, auto x, auto y) {
    std::vector<Series> all;
    for (const Block block : shown)
        for (const ComparedRow& row : block) {
            if (!row.stands()) continue;
            auto series = std::ranges::find(all, row.structure, &Series::name);
            if (series == all.end())
                series = all.insert(all.end(), {.name = row.structure, .x = {}, .y = {}});
            series->x.push_back(x(row));
            series->y.push_back(y(row));
            series->labels.push_back(row.spec);
        }
    return all;
}

}  // namespace

Chart pareto_chart(const Comparison& comparison) {
    std::vector<Block> shown;
    for (const std::string_view scene : pareto_scenes)
        for (const Block block : shown_blocks(comparison))
            if (block.front().scene == scene) shown.push_back(block);
    Ranges ranges;
    for (const Block block : shown)
        for (const ComparedRow& row : block)
            if (is_shown(row)) ranges.add(ready(row), trace_cost(row));
    Chart chart{.title =
                    "What structures take to build, and then for a ray, in six scenes: points, "
                    "and a line along those that none beats in both",
                .x_label = "build, ms",
                .y_label = "ns per ray",
                .series = series_over(shown, ready, trace_cost)};
    const std::size_t rows = (shown.size() + 1) / 2;
    Svg& svg = chart.drawing.emplace(chart.title, 640, 138 + pareto_row * double(rows));
    const double top = draw_families(svg, 8, 0, 620, large_families) + 56;
    svg.text(at(8, top - 34), "ns per ray", {.anchor = Anchor::start, .size = 16});
    const Axis x = log_axis(ranges.least_x, ranges.most_x, 6);
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const bool last_row = i + 2 >= shown.size();
        Ranges own;
        own.add(shown[i]);
        const Panel panel{pareto_left + double(i % 2) * pareto_step,
                          top + double(i / 2) * pareto_row,
                          pareto_width,
                          pareto_height,
                          x,
                          log_axis(own.least_y, own.most_y, 6)};
        draw_pareto(svg, panel, shown[i],
                    {.title = scene_text(shown[i].front().spec), .x_ticks = last_row});
    }
    svg.text(at(352, top + pareto_row * double(rows) + 10), "build, ms", {.size = 16});
    return chart;
}

Chart memory_chart(const Comparison& comparison) {
    const std::vector<Block> shown = shown_blocks(comparison);
    struct Mean {
        const ComparedRow* row;
        double bytes, cost;
    };
    std::vector<Mean> means;
    for (const std::string& name : structure_names(comparison, true)) {
        std::vector<double> bytes, costs;
        for (const Factor& factor : factors(shown, name)) costs.push_back(factor.factor);
        const ComparedRow* any = nullptr;
        for (const Block block : shown)
            if (const ComparedRow* row = find(block, name)) {
                bytes.push_back(double(row->bytes) / double(row->triangles));
                any = row;
            }
        // Few scenes that a structure can cope with are not the others' scenes.
        if (any && 4 * bytes.size() >= 3 * shown.size() && is_large_scale(*any))
            means.push_back({any, geometric_mean(bytes), geometric_mean(costs)});
    }
    Chart chart{.title = "Bytes a triangle against the cost of a ray, means over all scenes",
                .x_label = "bytes a triangle",
                .y_label = "ray's cost over that of the fastest",
                .series = {}};
    Ranges ranges;
    for (const auto& [row, bytes, cost] : means) {
        ranges.add(bytes, cost);
        chart.series.push_back({.name = row->structure, .x = {bytes}, .y = {cost}});
    }
    Svg& svg = chart.drawing.emplace(chart.title, 640, 560);
    const double top = draw_families(svg, 8, 0, 620, large_families) + 44;
    svg.text(at(8, top - 14), "a ray's cost, times that of the fastest",
             {.anchor = Anchor::start, .size = 16});
    const Panel panel{56,
                      top,
                      568,
                      560 - top - 58,
                      log_axis(ranges.least_x, ranges.most_x),
                      log_axis(std::min(1.0, ranges.least_y), ranges.most_y)};
    draw_panel(svg, panel);
    svg.text(at(340, 552), "bytes a triangle", {.size = 16});
    Labels labels({at(panel.left + 2, panel.top), at(638, panel.bottom() - 2)});
    for (const auto& [row, bytes, cost] : means) {
        draw_symbol(svg, panel.place(bytes, cost), family_of(*row).symbol);
        labels.keep_free(panel.place(bytes, cost), 7.0);
    }
    for (const auto& [row, bytes, cost] : means)
        labels.draw(svg, panel.place(bytes, cost), row->structure, {.size = 16, .halo = true});
    return chart;
}

}  // namespace space::ch12
