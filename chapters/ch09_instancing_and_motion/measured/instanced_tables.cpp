#include "chapters/ch09_instancing_and_motion/measured/instanced.hpp"
#include "common/measure.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch09 {
namespace {

constexpr std::string_view exact_test = "filtered exact";

std::string place(double away) {
    return away == 0.0 ? "0" : with_commas(static_cast<std::uint64_t>(away));
}

/// The exact test at every distance: what a way does to answers.
Table accuracy_table(const std::vector<AccuracyPoint>& accuracy) {
    Table table(
        {"from the origin", "way", "rays", "lost", "invented", "another triangle", "other bits"});
    for (const AccuracyPoint& p : accuracy)
        if (p.test == exact_test && p.way != in_flattened)
            table.row({place(p.away), std::string(p.way), with_commas(p.rays), with_commas(p.lost),
                       with_commas(p.invented), with_commas(p.other_triangles),
                       with_commas(p.other_bits)});
    return table;
}

/// All tests and ways, 10,000 from the origin.
Table speed_table(const std::vector<AccuracyPoint>& accuracy) {
    Table table({"test", "way", "differ", "million rays per second"});
    for (const AccuracyPoint& p : accuracy)
        if (p.away == 1e4)
            table.row({std::string(p.test), std::string(p.way),
                       fmt::format("{} of {}", with_commas(p.differ()), with_commas(p.rays)),
                       fixed(1e3 / p.ns, 2)});
    return table;
}

/// Scattered rays; of the trees' sizes, and of steps.
Table levels_table(const std::vector<LevelsPoint>& levels) {
    Table table({"object", "instances", "spacing", "triangles", "MB, flattened", "MB, two levels",
                 "nodes, flattened", "nodes", "tests, flattened", "tests"});
    for (const LevelsPoint& p : levels) {
        const LevelsCost& cost = p.diffuse;
        const auto per_ray = [&](std::uint64_t count) {
            return fixed(double(count) / double(cost.rays), 1);
        };
        table.row({p.object, with_commas(p.instances), fixed(p.spacing, 1),
                   with_commas(p.triangles), fixed(double(p.flat_bytes) / 1e6, 1),
                   fixed(double(p.bytes) / 1e6, 1), per_ray(cost.flat_nodes), per_ray(cost.nodes),
                   per_ray(cost.flat_tests), per_ray(cost.tests)});
    }
    return table;
}

/// Beside the flattened mesh's tree.
Table times_table(const std::vector<LevelsPoint>& levels) {
    Table table({"object", "instances", "spacing", "from around: flattened, ns", "local", "world",
                 "scattered: flattened, ns", "local", "world"});
    for (const LevelsPoint& p : levels) {
        const LevelsCost &around = p.from_around, &diffuse = p.diffuse;
        table.row({p.object, with_commas(p.instances), fixed(p.spacing, 1),
                   fixed(around.flat_ns, 0), fixed(around.local(), 2), fixed(around.world(), 2),
                   fixed(diffuse.flat_ns, 0), fixed(diffuse.local(), 2),
                   fixed(diffuse.world(), 2)});
    }
    return table;
}

/// For names of numbers: "1e6" of 10^6.
std::string place_name(double away) {
    int exponent = 0;
    for (double at = 1.0; at < away; at *= 10.0) ++exponent;
    return away == 0.0 ? "0" : fmt::format("1e{}", exponent);
}

/// The least and the most over the points, of scattered rays.
void quote_range(const std::vector<LevelsPoint>& levels, const std::string& name,
                 double (LevelsCost::*value)() const, Numbers& numbers) {
    const auto of = [&](const LevelsPoint& p) { return (p.diffuse.*value)(); };
    const auto [least, most] = std::ranges::minmax(levels, {}, of);
    numbers.time(name + "_least", of(least), fixed(of(least), 2));
    numbers.time(name + "_most", of(most), fixed(of(most), 2));
}

}  // namespace

InstancedMeasurements measure_instanced(const Options& options) {
    return {measured_once<measure_accuracy>(options), measured_once<measure_levels>(options)};
}

void print_instanced(const InstancedMeasurements& measured, bool times) {
    print_heading("Eight spheres as instances: answers that are not the flattened mesh's");
    accuracy_table(measured.accuracy).print();
    if (times) {
        print_heading("The same with each triangle test, 10,000 from the origin");
        speed_table(measured.accuracy).print();
    }
    print_heading("One object many times: two levels beside the flattened mesh's tree");
    levels_table(measured.levels).print();
    if (!times) return;
    print_heading("The same: times, that of the flattened mesh's tree = 1");
    times_table(measured.levels).print();
}

void quote_instanced(const InstancedMeasurements& measured, bool times, Numbers& numbers) {
    for (const AccuracyPoint& p : measured.accuracy) {
        if (p.test != exact_test) continue;
        if (p.way == in_local) {
            numbers.count("local_others_" + place_name(p.away), p.other_triangles);
            numbers.count("local_lost_" + place_name(p.away), p.lost + p.invented);
        } else if (p.way == without_margins) {
            numbers.count("bare_lost_" + place_name(p.away), p.differ());
        }
    }
    numbers.count_table("instanced_accuracy", accuracy_table(measured.accuracy));
    if (!times) return;
    numbers.time_table("instanced_speed", speed_table(measured.accuracy));
    numbers.time_table("two_levels", levels_table(measured.levels));
    numbers.time_table("two_levels_times", times_table(measured.levels));
    quote_range(measured.levels, "two_levels_local", &LevelsCost::local, numbers);
    quote_range(measured.levels, "two_levels_world", &LevelsCost::world, numbers);
    quote_range(measured.levels, "exact_usual", &LevelsCost::world_over_local, numbers);
    const auto far_ns = [&](std::string_view way) {
        for (const AccuracyPoint& p : measured.accuracy)
            if (p.test == exact_test && p.way == way && p.away == 1e6) return p.ns;
        return 0.0;
    };
    const double far = far_ns(in_world) / far_ns(in_flattened);
    numbers.time("far_exact_time", far, fixed(far, 0));
}

std::uint64_t wrong_instanced(const InstancedMeasurements& measured) {
    std::uint64_t wrong = 0;
    for (const AccuracyPoint& p : measured.accuracy)
        if (p.test == exact_test && (p.way == in_flattened || p.way == in_world))
            wrong += p.differ() + p.other_bits;
    for (const LevelsPoint& p : measured.levels) wrong += p.from_around.differ + p.diffuse.differ;
    return wrong;
}

// ---- charts -----------------------------------------------------------------------------------

Chart accuracy_chart(const std::vector<AccuracyPoint>& accuracy) {
    constexpr double none = 0.3;  // where a logarithmic axis shows that there is none
    Chart chart{.title = "Speed against answers that differ, by way and distance",
                .x_label = "answers of a million that are not the flattened mesh's; below 1: none",
                .y_label = "million rays per second",
                .log_x = true,
                .kind = ChartKind::points,
                .series = {}};
    for (const std::string_view way : {in_flattened, in_world, in_local, without_margins}) {
        Series series{.name = std::string(way), .x = {}, .y = {}};
        for (const AccuracyPoint& p : accuracy) {
            if (p.test != exact_test || p.way != way || p.away == 0.0) continue;
            series.x.push_back(p.differ() > 0 ? 1e6 * p.share() : none);
            series.y.push_back(1e3 / p.ns);
            series.labels.push_back(p.differ() > 0 && p.away >= 1e4 ? place(p.away) : "");
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

Chart away_chart(const std::vector<AccuracyPoint>& accuracy) {
    Chart chart{.title = "Answers that differ against the distance from the origin",
                .x_label = "distance from the origin, objects of size 1",
                .y_label = "answers of a million that are not the flattened mesh's",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string_view way : {in_local, without_margins})
        chart.series.push_back(series_along(
            std::string(way), accuracy | std::views::filter([way](const AccuracyPoint& p) {
                                  return p.test == exact_test && p.way == way && p.away > 0.0;
                              }),
            &AccuracyPoint::away, [](const AccuracyPoint& p) { return 1e6 * p.share(); }));
    return chart;
}

Chart levels_chart(const std::vector<LevelsPoint>& levels) {
    Chart chart{.title = "Two levels beside the flattened mesh's tree, scattered rays",
                .x_label = "triangles of the flattened mesh",
                .y_label = "time of a ray, in the flattened mesh = 1",
                .log_x = true,
                .series = {}};
    for (const std::string_view object : {"icosphere:22", "stadium", "bunny"})
        for (const auto& [name, value] :
             {std::pair{"local", &LevelsCost::local}, {"world", &LevelsCost::world}})
            chart.series.push_back(
                series_along(fmt::format("{}, {}", object, name),
                             levels | std::views::filter([object](const LevelsPoint& p) {
                                 return p.object == object && p.spacing > 0.5;
                             }),
                             &LevelsPoint::triangles,
                             [value](const LevelsPoint& p) { return (p.diffuse.*value)(); }));
    return chart;
}

}  // namespace space::ch09
