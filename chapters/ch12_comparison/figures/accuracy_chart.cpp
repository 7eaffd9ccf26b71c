#include "chapters/ch12_comparison/figures/accuracy_chart.hpp"

#include "chapters/ch12_comparison/figures/chart_parts.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch12 {
namespace {

/// The lab's tests, and what peers have.
struct TestLook {
    std::string_view test, name;
    Symbol symbol;
};
constexpr std::array<TestLook, 4> test_looks{{
    {"filtered-exact", "filtered exact", {Shape::circle, Ink::blue}},
    {"moller-trumbore-float", "M\u00f6ller-Trumbore", {Shape::square, Ink::vermillion, false, 5.5}},
    {"watertight", "watertight", {Shape::triangle, Ink::green, false, 6.5}},
    {"its own", "others' code", {Shape::diamond, Ink::ink, true, 6.5}},
}};

const TestLook& look_of(std::string_view test) {
    for (const TestLook& look : test_looks)
        if (test.starts_with(look.test)) return look;
    return test_looks[1];
}

/// None stands at the foot of the chart, below what the rays could tell.
double foot_of(std::span<const AccuracyRow> rows) {
    double rays = 0.0;
    for (const AccuracyRow& row : rows)
        if (row.structure == rows.front().structure && row.test == rows.front().test)
            rays += double(row.rays);
    return 0.25e6 / rays;
}

/// Has its name in the chart: with the exact test one of each kind, with the others a few.
bool is_named(const AccuracyPoint& point) {
    return stands_for_its_kind(point) && (point.is_peer || point.test == test_looks[0].test ||
                                          point.structure == "naive" || point.structure == "bsp");
}

}  // namespace

Chart accuracy_chart(std::span<const AccuracyRow> rows) {
    const std::vector<AccuracyPoint> points = accuracy_points(rows);
    Chart chart{.title =
                    "Wrong answers of rays at edges, vertices and along faces against the "
                    "time of a ray: every structure with every triangle test",
                .x_label = "ns per ray",
                .y_label = "wrong per million rays",
                .series = {}};
    double least = infinity, most = 0.0, wrong = 100.0;
    for (const AccuracyPoint& point : points) {
        auto series = std::ranges::find(chart.series, point.test, &Series::name);
        if (series == chart.series.end())
            series = chart.series.insert(series, {.name = point.test, .x = {}, .y = {}});
        series->x.push_back(point.ns_per_ray);
        series->y.push_back(point.per_million);
        series->labels.push_back(point.structure);
        least = std::min(least, point.ns_per_ray), most = std::max(most, point.ns_per_ray);
        wrong = std::max(wrong, point.per_million);
    }
    Svg& svg = chart.drawing.emplace(chart.title, 640, 540);
    std::vector<KeyEntry> key;
    for (const TestLook& look : test_looks) key.push_back({look.name, look.symbol});
    const double top = draw_key(svg, 8, 0, 630, key) + 44;
    svg.text(at(8, top - 16), "wrong answers per million rays",
             {.anchor = Anchor::start, .size = 16});
    const double foot = foot_of(rows);
    Axis y = log_axis(foot, wrong);
    std::erase_if(y.ticks, [&](const Tick& tick) { return tick.value < 3 * foot; });
    y.ticks.push_back({foot, "none"});
    const Panel panel{74, top, 552, 540 - top - 58, log_axis(least, most), y};
    draw_panel(svg, panel);
    svg.text(at(350, 532), "ns per ray, one thread", {.size = 16});
    const auto place = [&](const AccuracyPoint& point) {
        return panel.place(point.ns_per_ray, std::max(point.per_million, foot));
    };
    Labels labels({at(panel.left + 2, panel.top), at(638, panel.bottom() - 2)});
    for (const AccuracyPoint& point : points) {
        draw_symbol(svg, place(point), look_of(point.test).symbol);
        labels.keep_free(place(point), 7.0);
    }
    for (const AccuracyPoint& point : points)
        if (is_named(point))
            labels.draw(svg, place(point), point.structure, {.size = 16, .halo = true});
    return chart;
}

}  // namespace space::ch12
