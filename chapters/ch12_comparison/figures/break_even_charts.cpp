#include "chapters/ch12_comparison/figures/chart_parts.hpp"
#include "chapters/ch12_comparison/figures/comparison_charts.hpp"
#include "chapters/ch12_comparison/measured/break_even.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch12 {
namespace {

/// A structure is the cheapest one between two numbers of rays.
struct StripPart {
    std::string structure;
    double from, to;
};

std::vector<StripPart> strip(Block block) {
    const std::vector<CostLine> lines = cost_lines(block, false);
    std::vector<StripPart> parts;
    for (const auto& [line, from, to] : lower_envelope(lines, fewest_rays, most_rays)) {
        if (!parts.empty() && parts.back().structure == lines[line].name)
            parts.back().to = to;
        else
            parts.push_back({lines[line].name, from, to});
    }
    return parts;
}

/// An area's look: there are more structures than colours, so each also has a number.
struct Look {
    Ink ink;
    double opacity;
};
constexpr std::array<Look, 14> looks{{{Ink::blue, 0.45},
                                      {Ink::orange, 0.55},
                                      {Ink::green, 0.45},
                                      {Ink::vermillion, 0.5},
                                      {Ink::sky, 0.45},
                                      {Ink::yellow, 0.5},
                                      {Ink::purple, 0.45},
                                      {Ink::quiet, 0.35},
                                      {Ink::blue, 0.2},
                                      {Ink::orange, 0.25},
                                      {Ink::green, 0.2},
                                      {Ink::vermillion, 0.22},
                                      {Ink::purple, 0.2},
                                      {Ink::quiet, 0.15}}};

constexpr double strip_left = 126, strip_right = 628, strip_row = 32, strip_height = 25;

/// Where so many rays lie along a strip.
double strip_x(double rays) {
    return strip_left + (strip_right - strip_left) * std::log10(rays) / 10.0;
}

constexpr std::array<KeyEntry, 7> total_structures{{
    {"naive", {Shape::star, Ink::ink, false, 6}},
    {"kd-lazy", {Shape::square, Ink::green, true, 5}},
    {"octree-linear", {Shape::diamond, Ink::orange, false, 6}},
    {"bvh-parallel-morton", {Shape::circle, Ink::sky, true, 5}},
    {"bvh-binned", {Shape::circle, Ink::blue, false, 5}},
    {"fast", {Shape::triangle, Ink::vermillion, false, 5}},
    {"fast-hq", {Shape::triangle, Ink::purple, true, 5}},
}};

/// A structure's cost at four numbers of rays a decade, in ms.
Series total_cost_series(std::span<const CostLine> lines, std::string_view name) {
    std::vector<CostLine> own;
    std::ranges::copy_if(lines, std::back_inserter(own),
                         [&](const CostLine& line) { return line.name == name; });
    Series series{.name = std::string(name), .x = {}, .y = {}};
    for (int step = 0; step <= 36 && !own.empty(); ++step) {
        const double rays = std::pow(10.0, 0.25 * step);
        series.x.push_back(rays);
        series.y.push_back(own[cheapest(own, rays)].cost(rays) / 1e6);
    }
    return series;
}

/// Structures with a part in some strip, in the order in which they take turns there.
std::vector<std::string> named_in(const std::vector<std::vector<StripPart>>& strips) {
    std::map<std::string, std::pair<double, int>> middles;
    for (const auto& parts : strips)
        for (const StripPart& part : parts) {
            if (part.to < 1.2 * part.from) continue;  // nothing that could be seen
            middles[part.structure].first += std::log10(part.from * part.to);
            ++middles[part.structure].second;
        }
    std::vector<std::string> names;
    for (const auto& [name, sum] : middles) names.push_back(name);
    std::ranges::sort(names, {}, [&](const std::string& name) {
        return middles[name].first / middles[name].second;
    });
    return names;
}

double draw_strip_key(Svg& svg, const std::vector<std::string>& names) {
    double x = 8, y = 8;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double wide = 34 + text_width(names[i], 16) + 16;
        if (x + wide - 16 > 634) x = 8, y += 30;
        const Look& look = looks[i % looks.size()];
        svg.rect(at(x, y), {28, 22}, {.stroke = {}, .fill = look.ink, .opacity = look.opacity});
        svg.text(at(x + 14, y + 17), std::to_string(i + 1), {.size = 16});
        svg.text(at(x + 34, y + 17), names[i], {.anchor = Anchor::start, .size = 16});
        x += wide;
    }
    return y + 30;
}

}  // namespace

Chart break_even_chart(const Comparison& comparison) {
    const std::vector<Block> shown = shown_blocks(comparison);
    std::vector<std::vector<StripPart>> strips;
    for (const Block block : shown) strips.push_back(strip(block));
    const std::vector<std::string> names = named_in(strips);
    Chart chart{.title =
                    "For so many rays, which structure costs the least, build and rays "
                    "together? A strip for each scene",
                .x_label = "from so many rays",
                .y_label = "to so many rays",
                .log_x = true,
                .log_y = true,
                .series = {}};
    const double rows = strip_row * double(shown.size());
    Svg& svg = chart.drawing.emplace(chart.title, 640, 96 + 30.0 * 4 + rows);
    const double top = draw_strip_key(svg, names) + 14;
    for (int decade = 0; decade <= 10; ++decade) {
        const double x = strip_x(std::pow(10.0, decade));
        svg.line(at(x, top - 4), at(x, top + rows), {.stroke = Ink::faint});
        constexpr std::array<std::string_view, 6> ticks{"1", "100", "10 K", "1 M", "100 M", "10 G"};
        if (decade % 2 == 0)
            svg.text(at(x, top + rows + 20), ticks[std::size_t(decade) / 2],
                     {.anchor = decade == 10 ? Anchor::end : Anchor::middle, .size = 16});
    }
    svg.text(at(0.5 * (strip_left + strip_right), top + rows + 44), "rays", {.size = 16});
    for (std::size_t s = 0; s < strips.size(); ++s) {
        const double y = top + strip_row * double(s);
        svg.text(at(strip_left - 8, y + 18), scene_text(shown[s].front().scene),
                 {.anchor = Anchor::end, .size = 16});
        for (const StripPart& part : strips[s]) {
            const auto index =
                std::size_t(std::ranges::find(names, part.structure) - names.begin());
            chart.series.push_back({.name = part.structure,
                                    .x = {part.from},
                                    .y = {part.to},
                                    .labels = {shown[s].front().spec}});
            if (index == names.size()) continue;
            const double from = strip_x(part.from), to = strip_x(part.to);
            const Look& look = looks[index % looks.size()];
            svg.rect(at(from, y), Vector2(glm::dvec2(to - from, strip_height)),
                     {.stroke = {}, .fill = Ink::paper});
            svg.rect(at(from, y), Vector2(glm::dvec2(to - from, strip_height)),
                     {.stroke = {}, .fill = look.ink, .opacity = look.opacity});
            svg.line(at(from, y), at(from, y + strip_height), {.stroke = Ink::paper});
            const std::string number = std::to_string(index + 1);
            if (text_width(part.structure, 16) + 8 < to - from)
                svg.text(at(0.5 * (from + to), y + 18), part.structure, {.size = 16});
            else if (text_width(number, 16) + 3 < to - from)
                svg.text(at(0.5 * (from + to), y + 18), number, {.size = 16});
        }
    }
    return chart;
}

Chart total_cost_chart(const Comparison& comparison) {
    Block block = shown_blocks(comparison).front();
    for (const Block other : shown_blocks(comparison))
        if (other.front().scene == "stadium") block = other;
    Chart chart{.title = fmt::format("Build and rays together against the number of rays, in {}",
                                     scene_text(block.front().spec)),
                .x_label = "rays",
                .y_label = "build and rays, ms",
                .log_x = true,
                .log_y = true,
                .series = {}};
    const std::vector<CostLine> lines = cost_lines(block, false);
    std::vector<KeyEntry> key;
    double least = infinity, most = 0.0;
    for (const auto& [name, symbol] : total_structures) {
        Series series = total_cost_series(lines, name);
        if (series.x.empty()) continue;
        key.push_back({name, symbol});
        least = std::min(least, series.y.front()), most = std::max(most, series.y.back());
        chart.series.push_back(std::move(series));
    }
    Svg& svg = chart.drawing.emplace(chart.title, 640, 500);
    const double top = draw_key(svg, 8, 0, 620, key) + 62;
    svg.text(at(8, top - 38), "build and rays, ms", {.anchor = Anchor::start, .size = 16});
    const Panel panel{
        74, top, 552, 500 - top - 56, log_axis(1.0, 1e9), log_axis(least, std::min(most, 1e9))};
    draw_panel(svg, panel, {.title = scene_text(block.front().spec)});
    for (std::size_t s = 0; s < chart.series.size(); ++s) {
        const Series& series = chart.series[s];
        std::vector<Point2> line;
        for (std::size_t i = 0; i < series.x.size() && series.y[i] <= panel.y.high; ++i)
            line.push_back(panel.place(series.x[i], series.y[i]));
        svg.polyline(line, {.stroke = key[s].symbol.ink});
        for (std::size_t i = s; i < line.size(); i += 8) draw_symbol(svg, line[i], key[s].symbol);
    }
    svg.text(at(350, 492), "rays", {.size = 16});
    return chart;
}

}  // namespace space::ch12
