#include "chapters/ch12_comparison/figures/advice_charts.hpp"

#include "chapters/ch12_comparison/figures/chart_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space::ch12 {
namespace {

constexpr double good_ratio = 1.15;

std::vector<double> sorted_ratios(std::span<const AdviceCase> cases) {
    std::vector<double> ratios;
    for (const AdviceCase& asked : cases)
        if (std::isfinite(asked.ratio())) ratios.push_back(asked.ratio());
    std::ranges::sort(ratios);
    return ratios;
}

/// One group of questions: what it is called, and its line.
struct AdviceLine {
    std::string_view name;
    std::span<const AdviceCase> cases;
    Symbol symbol;
};

void draw_advice_line(Svg& svg, const Panel& panel, const AdviceLine& line, Chart& chart) {
    const std::vector<double> ratios = sorted_ratios(line.cases);
    Series series{.name = std::string(line.name), .x = {}, .y = {}};
    std::vector<Point2> points;
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        series.x.push_back(100.0 * (double(i) + 1.0) / double(ratios.size()));
        series.y.push_back(ratios[i]);
        points.push_back(panel.place(series.x.back(), series.y.back()));
    }
    if (points.size() > 1) svg.polyline(points, {.stroke = line.symbol.ink});
    for (std::size_t i = 0; i < points.size(); ++i)
        if (ratios[i] > good_ratio) draw_symbol(svg, points[i], line.symbol);
    chart.series.push_back(std::move(series));
}

/// "10^5" with the power raised is more than a drawing's text can do: "100 K".
std::string ray_count_text(double rays) {
    return tick_text(rays, 1e10);
}

void draw_advice_cell(Svg& svg, Point2 corner, Vector2 size, const AdviceCase& asked) {
    const double ratio = asked.ratio();
    // Nothing where it is the best, the whole colour at four times the best one's cost.
    const double share = std::clamp(std::log(ratio) / std::log(4.0), 0.0, 1.0);
    svg.rect(corner, size,
             {.stroke = {},
              .fill = asked.is_good() ? Ink::blue : Ink::vermillion,
              .opacity = asked.is_good() ? 0.12 : std::round(100.0 * (0.2 + 0.5 * share)) / 100.0});
    svg.text(corner + Vector2(0.5f * size.x, 0.72f * size.y),
             ratio < 9.95 ? fmt::format("{:.1f}", ratio) : fmt::format("{:.0f}", ratio),
             {.size = 15, .bold = !asked.is_good()});
}

}  // namespace

Chart advice_chart(const JudgedAdvice& judged) {
    const std::array<AdviceLine, 3> lines{{
        {"fitted", judged.fitted, {Shape::circle, Ink::quiet, true, 4.5}},
        {"other half", judged.other_half, {Shape::circle, Ink::blue, false, 4.5}},
        {"from files", judged.fetched, {Shape::triangle, Ink::vermillion, false, 5}},
    }};
    Chart chart{.title =
                    "What the advised structure costs over the best in hindsight, for all "
                    "questions, from the best answered to the worst",
                .x_label = "% of the questions",
                .y_label = "times the best",
                .log_y = true,
                .series = {}};
    double most = 2.0;
    for (const AdviceLine& line : lines)
        for (const double ratio : sorted_ratios(line.cases)) most = std::max(most, ratio);
    Svg& svg = chart.drawing.emplace(chart.title, 640, 440);
    std::vector<KeyEntry> key;
    for (const AdviceLine& line : lines)
        if (!line.cases.empty()) key.push_back({line.name, line.symbol});
    const double top = draw_key(svg, 8, 0, 620, key) + 40;
    svg.text(at(8, top - 14), "cost, times that of the best in hindsight",
             {.anchor = Anchor::start, .size = 16});
    const Panel panel{62, top, 560, 440 - top - 56, linear_axis(0, 100), log_axis(1.0, most)};
    draw_panel(svg, panel);
    svg.line(panel.place(0, good_ratio), panel.place(100, good_ratio),
             {.stroke = Ink::green, .dashed = true});
    svg.text(moved(panel.place(2, good_ratio), 0, -6), fmt::format("{} times the best", good_ratio),
             {.anchor = Anchor::start, .ink = Ink::green, .size = 16, .halo = true});
    svg.line(panel.place(90, panel.y.low), panel.place(90, panel.y.high),
             {.stroke = Ink::green, .dashed = true});
    for (const AdviceLine& line : lines) draw_advice_line(svg, panel, line, chart);
    svg.text(at(342, 432), "% of the questions", {.size = 16});
    return chart;
}

Chart advice_misses_chart(const JudgedAdvice& judged) {
    std::vector<AdviceCase> unseen = judged.other_half;
    unseen.insert(unseen.end(), judged.fetched.begin(), judged.fetched.end());
    std::vector<std::string> specs;
    std::vector<double> rays;
    for (const AdviceCase& asked : unseen) {
        if (std::ranges::find(specs, asked.spec) == specs.end()) specs.push_back(asked.spec);
        if (std::ranges::find(rays, asked.rays) == rays.end()) rays.push_back(asked.rays);
    }
    std::ranges::sort(rays);
    Chart chart{.title =
                    "What the advised structure costs over the best in hindsight, on scenes "
                    "that the advice was not fitted on, by the number of rays",
                .x_label = "rays",
                .y_label = "times the best",
                .log_x = true,
                .series = {}};
    constexpr double left = 178, top = 48, row = 26;
    Svg& svg = chart.drawing.emplace(chart.title, 640, top + row * double(specs.size()) + 6);
    const double width = (634 - left) / std::max(1.0, double(rays.size()));
    svg.text(at(left - 10, top - 8), "rays:", {.anchor = Anchor::end, .size = 16});
    for (std::size_t i = 0; i < rays.size(); ++i)
        svg.text(at(left + width * (double(i) + 0.5), top - 8 - (i % 2 == 1 ? 20 : 0)),
                 ray_count_text(rays[i]), {.size = 16});
    for (std::size_t s = 0; s < specs.size(); ++s) {
        const double y = top + row * double(s);
        const std::string name = specs[s].starts_with("graph/") ? specs[s].substr(6) : specs[s];
        svg.text(at(left - 10, y + 18), scene_text(name), {.anchor = Anchor::end, .size = 15});
        Series series{.name = specs[s], .x = {}, .y = {}};
        for (const AdviceCase& asked : unseen) {
            if (asked.spec != specs[s] || !std::isfinite(asked.ratio())) continue;
            const auto i = std::size_t(std::ranges::find(rays, asked.rays) - rays.begin());
            draw_advice_cell(svg, at(left + width * double(i), y),
                             Vector2(glm::dvec2(width - 1, row - 1)), asked);
            series.x.push_back(asked.rays);
            series.y.push_back(asked.ratio());
            series.labels.push_back(asked.advised + " for " + asked.best);
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

}  // namespace space::ch12
