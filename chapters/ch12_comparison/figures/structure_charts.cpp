#include "chapters/ch12_comparison/figures/chart_parts.hpp"
#include "chapters/ch12_comparison/figures/comparison_charts.hpp"
#include "common/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace space::ch12 {
namespace {

/// "1.0", "12", "3K": three characters at most, up to a million.
std::string short_ratio(double ratio) {
    if (ratio < 9.95) return fmt::format("{:.1f}", ratio);
    if (ratio < 999.5) return fmt::format("{:.0f}", ratio);
    return fmt::format("{:.0f}K", ratio / 1e3);
}

/// A structure's row of the table of ratios, and its middle one.
struct RegretRow {
    std::string structure;
    const ComparedRow* any;
    std::vector<double> ratios;  ///< for each block; unknown where it gave up
    double middle;
};

std::vector<RegretRow> regrets(const Comparison& comparison, std::span<const Block> shown) {
    std::vector<RegretRow> rows;
    for (const std::string& name : structure_names(comparison, true)) {
        RegretRow row{.structure = name, .any = nullptr, .ratios = {}, .middle = infinity};
        for (const Block block : shown) {
            const ComparedRow* found = find(block, name);
            row.ratios.push_back(found ? ray_cost(*found) / ray_cost(*by_ray_cost(block).front())
                                       : unknown);
            if (found) row.any = found;
        }
        if (!row.any) continue;
        // One that gave up is worse than any that stands.
        std::vector<double> sorted = row.ratios;
        for (double& ratio : sorted)
            if (!std::isfinite(ratio)) ratio = infinity;
        std::ranges::nth_element(sorted, sorted.begin() + std::ptrdiff_t(sorted.size() / 2));
        row.middle = sorted[sorted.size() / 2];
        rows.push_back(std::move(row));
    }
    std::ranges::stable_sort(rows, {}, &RegretRow::middle);
    return rows;
}

void draw_cell(Svg& svg, Point2 corner, Vector2 size, double ratio) {
    if (!std::isfinite(ratio)) {
        svg.text(corner + Vector2(0.5f * size.x, 0.72f * size.y), "-", {.ink = Ink::quiet});
        return;
    }
    // Nothing at the best one, the whole colour at a hundred times its cost.
    const double share = std::clamp(std::log(ratio) / std::log(100.0), 0.0, 1.0);
    const bool best = ratio < 1.0005;  // a peer may be better still
    svg.rect(corner, size,
             {.stroke = {},
              .fill = best ? Ink::blue : Ink::orange,
              .opacity = best ? 0.35 : std::round(100.0 * (0.04 + 0.51 * share)) / 100.0});
    svg.text(corner + Vector2(0.5f * size.x, 0.7f * size.y), short_ratio(ratio),
             {.size = 14, .bold = best});
}

constexpr double regret_left = 172, regret_top = 108, regret_row = 25;

/// Million rays a second: from the slowest scene to the fastest a line, the middle one a dot.
struct KindRange {
    double least, middle, most;
};
KindRange range_over(std::span<const Block> shown, std::string_view structure, RayKind kind) {
    std::vector<double> speeds;
    for (const Block block : shown)
        if (const ComparedRow* row = find(block, structure))
            if (const double ns = (*row)[kind].ns_per_ray; std::isfinite(ns))
                speeds.push_back(1e3 / ns);
    if (speeds.empty()) return {unknown, unknown, unknown};
    const auto [least, most] = std::ranges::minmax(speeds);
    return {least, median(speeds), most};
}

}  // namespace

Chart regret_chart(const Comparison& comparison) {
    const std::vector<Block> shown = shown_blocks(comparison);
    const std::vector<RegretRow> rows = regrets(comparison, shown);
    Chart chart{.title =
                    "What a ray costs in each structure, times what it costs in the fastest of "
                    "the book's, scene by scene",
                .x_label = "scene",
                .y_label = "times the fastest",
                .kind = ChartKind::bars,
                .series = {}};
    for (const Block block : shown) chart.categories.push_back(block.front().spec);
    for (const RegretRow& row : rows)
        chart.series.push_back({.name = row.structure, .x = {}, .y = row.ratios});
    const double height = regret_top + regret_row * double(rows.size()) + 8;
    Svg& svg = chart.drawing.emplace(chart.title, 640, height);
    const double width = std::min(34.0, (618 - regret_left) / double(shown.size()));
    for (std::size_t i = 0; i < shown.size(); ++i)
        svg.text(at(regret_left + width * (double(i) + 0.72), regret_top - 8),
                 scene_text(shown[i].front().scene),
                 {.anchor = Anchor::start, .size = 16, .turn = -62});
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const double y = regret_top + regret_row * double(r);
        draw_symbol(svg, at(10, y + 12), family_of(*rows[r].any).symbol);
        svg.text(at(22, y + 18), rows[r].structure, {.anchor = Anchor::start, .size = 15});
        for (std::size_t i = 0; i < shown.size(); ++i)
            draw_cell(svg, at(regret_left + width * double(i), y),
                      Vector2(glm::dvec2(width - 1, regret_row - 1)), rows[r].ratios[i]);
    }
    return chart;
}

Chart ray_kinds_chart(const Comparison& comparison) {
    const std::vector<Block> shown = shown_blocks(comparison);
    std::vector<RegretRow> rows = regrets(comparison, shown);
    std::erase_if(rows, [](const RegretRow& row) {
        return !std::isfinite(row.middle) || row.structure == "naive";
    });
    Chart chart{.title =
                    "Rays a second by kind of ray and structure: its slowest, its middle and "
                    "its fastest scene",
                .x_label = "kind",
                .y_label = "million rays per second",
                .kind = ChartKind::bars,
                .series = {}};
    double least = infinity, most = 0.0;
    for (const std::string_view kind : ray_kind_names)
        for (const char* which : {"slowest", "middle", "fastest"})
            chart.categories.push_back(fmt::format("{}, {} scene", kind, which));
    for (const RegretRow& row : rows) {
        Series series{.name = row.structure, .x = {}, .y = {}};
        for (const RayKind kind : ray_kinds) {
            const KindRange range = range_over(shown, row.structure, kind);
            for (const double value : {range.least, range.middle, range.most})
                series.y.push_back(value);
            if (std::isfinite(range.least))
                least = std::min(least, range.least), most = std::max(most, range.most);
        }
        chart.series.push_back(std::move(series));
    }
    constexpr double left = 172, top = 44, row_height = 25, gap = 12;
    const double width = (636 - left) / 4 - gap, height = row_height * double(rows.size());
    Svg& svg = chart.drawing.emplace(chart.title, 640, top + height + 56);
    const Axis speed = log_axis(least, most);
    for (std::size_t k = 0; k < ray_kinds.size(); ++k) {
        const Panel panel{left + double(k) * (width + gap), top, width, height, speed,
                          {.high = double(rows.size())}};
        draw_panel(svg, panel, {.title = ray_kind_names[k], .size = 15});
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const KindRange range = range_over(shown, rows[r].structure, ray_kinds[k]);
            if (!std::isfinite(range.least)) continue;
            const double y = double(rows.size() - r) - 0.5;
            svg.line(panel.place(range.least, y), panel.place(range.most, y),
                     {.stroke = family_of(*rows[r].any).symbol.ink});
            draw_symbol(svg, panel.place(range.middle, y), family_of(*rows[r].any).symbol);
        }
    }
    for (std::size_t r = 0; r < rows.size(); ++r)
        svg.text(at(left - 8, top + row_height * (double(r) + 0.72)), rows[r].structure,
                 {.anchor = Anchor::end, .size = 15});
    svg.text(at(left + 232, top + height + 48), "million rays per second, one thread",
             {.size = 16});
    return chart;
}

}  // namespace space::ch12
