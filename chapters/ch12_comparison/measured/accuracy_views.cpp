#include "chapters/ch12_comparison/measured/accuracy_data.hpp"
#include "chapters/ch12_comparison/measured/chart_parts.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
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

/// One of each kind has its row in the table.
bool is_in_table(const AccuracyPoint& point) {
    constexpr std::array<std::string_view, 7> shown{
        "naive", "bsp", "kd-sah", "octree", "bvh-binned", "fast", "fast-compressed"};
    return point.is_peer || std::ranges::find(shown, point.structure) != shown.end();
}

/// And its name in the chart, with the exact test; with the others a few.
bool is_named(const AccuracyPoint& point) {
    return is_in_table(point) && (point.is_peer || point.test == test_looks[0].test ||
                                  point.structure == "naive" || point.structure == "bsp");
}

}  // namespace

std::vector<AccuracyPoint> accuracy_points(std::span<const AccuracyRow> rows) {
    std::vector<AccuracyPoint> points;
    for (const AccuracyRow& row : rows) {
        const auto is_same = [&](const auto& other) {
            return other.structure == row.structure && other.test == row.test;
        };
        if (std::ranges::any_of(points, is_same)) continue;
        std::vector<double> times;
        double wrong = 0.0, asked = 0.0;
        for (const AccuracyRow& other : rows)
            if (is_same(other)) {
                times.push_back(other.ns_per_ray);
                wrong += double(other.wrong());
                asked += double(other.rays);
            }
        points.push_back({row.structure, row.test, row.home, row.is_peer, geometric_mean(times),
                          1e6 * wrong / asked});
    }
    return points;
}

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

void quote_accuracy(std::span<const AccuracyRow> rows, Numbers& numbers) {
    const std::vector<AccuracyPoint> points = accuracy_points(rows);
    Table table({"structure", "triangle test", "home", "ns per ray", "wrong per million"});
    double exact = 0.0, most = 0.0;
    for (const AccuracyPoint& point : points) {
        exact += point.per_million == 0.0;
        most = std::max(most, point.per_million);
        if (is_in_table(point))
            table.row({point.structure, point.test, point.home,
                       with_commas(static_cast<std::uint64_t>(std::lround(point.ns_per_ray))),
                       with_commas(static_cast<std::uint64_t>(std::lround(point.per_million)))});
    }
    // With others' code there are more of them: a machine's affair, as times are.
    std::set<std::string> scenes;
    for (const AccuracyRow& row : rows) scenes.insert(row.scene);
    const auto whole = [&](const std::string& name, double value) {
        numbers.time(name, value, with_commas(static_cast<std::uint64_t>(std::lround(value))));
    };
    whole("accuracy_points", double(points.size()));
    whole("accuracy_exact_points", exact);
    whole("accuracy_most", most);
    whole("accuracy_rays", double(rows.front().rays) * double(scenes.size()));
    whole("accuracy_scenes", double(scenes.size()));
    numbers.time_table("accuracy", table);
}

}  // namespace space::ch12
