#include "chapters/ch09_instancing_and_motion/measured/nesting.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch09 {
namespace {

constexpr std::string_view all_ways[]{nesting_way::exact, nesting_way::usual,
                                      nesting_way::flattened, nesting_way::embree,
                                      nesting_way::embree_flattened};

double mega_rays(const NestingTrace& trace) {
    return 1e3 / trace.ray_ns;
}
std::string kilobytes(std::size_t bytes) {
    return with_commas((bytes + 500) / 1000);
}
std::string levels_of(const std::string& scene) {
    return scene.substr(scene.find(':') + 1);
}
/// Up to what is measured: a dash where a way is not.
template <class Value>
std::string way_text(const NestingPoint& point, std::string_view way, const Value& value) {
    const NestingTrace* const trace = point.by(way);
    return trace ? value(*trace) : "-";
}

Table growth_table(const std::vector<NestingPoint>& levels) {
    Table table({"levels", "triangles", "instances", "spheres", "kilobytes", "nodes per ray",
                 "tests per ray", "hits", "usual way: other triangle", "other bits"});
    for (const NestingPoint& p : levels)
        table.row({levels_of(p.scene), with_commas(p.triangles), with_commas(p.instances),
                   with_commas(p.places), kilobytes(p.by(nesting_way::exact)->bytes),
                   fixed(p.visits, 1), fixed(p.tests, 1), with_commas(p.hits),
                   with_commas(p.by(nesting_way::usual)->other_answer()),
                   with_commas(p.by(nesting_way::usual)->other_bits)});
    return table;
}

/// Of all ways, side by side.
template <class Value>
Table ways_table(const std::vector<NestingPoint>& points, const Value& value) {
    std::vector<std::string> headings{"triangles"};
    for (const std::string_view way : all_ways) headings.emplace_back(way);
    Table table(headings);
    for (const NestingPoint& p : points) {
        std::vector<std::string> cells{with_commas(p.triangles)};
        for (const std::string_view way : all_ways) cells.push_back(way_text(p, way, value));
        table.row(cells);
    }
    return table;
}
Table bytes_table(const std::vector<NestingPoint>& points) {
    return ways_table(points, [](const NestingTrace& trace) { return kilobytes(trace.bytes); });
}
Table speeds_table(const std::vector<NestingPoint>& points) {
    return ways_table(points, [](const NestingTrace& trace) { return fixed(mega_rays(trace), 2); });
}
Table differences_table(const std::vector<NestingPoint>& points) {
    return ways_table(points,
                      [](const NestingTrace& trace) { return with_commas(trace.other_answer()); });
}

TimedTable large_table(const std::vector<NestingPoint>& large, bool times) {
    TimedTable table({"scene", "triangles", "objects", "instances", "places of meshes", "kilobytes",
                      "nodes per ray", "tests per ray", "usual way: other triangle", "other bits"},
                     {"Mrays/s, exact", "as usual"}, times);
    for (const NestingPoint& p : large) {
        const NestingTrace &exact = *p.by(nesting_way::exact), &usual = *p.by(nesting_way::usual);
        table.row(
            {p.scene, with_commas(p.triangles), with_commas(p.objects), with_commas(p.instances),
             with_commas(p.places), kilobytes(exact.bytes), fixed(p.visits, 1), fixed(p.tests, 1),
             with_commas(usual.other_answer()), with_commas(usual.other_bits)},
            {fixed(mega_rays(exact), 2), fixed(mega_rays(usual), 2)});
    }
    return table;
}

const NestingPoint& largest_with(const std::vector<NestingPoint>& points, std::string_view way) {
    return *std::ranges::max_element(
        points, {}, [&](const NestingPoint& p) { return p.by(way) ? p.triangles : 0; });
}

/// The largest scene that a way was measured on, and how it compares there.
void quote_beside(const std::vector<NestingPoint>& levels, std::string_view way,
                  const std::string& name, Numbers& numbers) {
    const NestingPoint& p = largest_with(levels, way);
    if (!p.by(way)) return;
    const NestingTrace &other = *p.by(way), &exact = *p.by(nesting_way::exact),
                       &usual = *p.by(nesting_way::usual);
    numbers.time(name + "_triangles", double(p.triangles), with_commas(p.triangles));
    numbers.time(name + "_megabytes", double(other.bytes) * 1e-6,
                 fixed(double(other.bytes) * 1e-6, 0));
    numbers.time(
        name + "_memory_ratio", double(other.bytes) / double(exact.bytes),
        with_commas(static_cast<std::uint64_t>(double(other.bytes) / double(exact.bytes))));
    numbers.time(name + "_exact_time", exact.ray_ns / other.ray_ns,
                 fixed(exact.ray_ns / other.ray_ns, 2));
    numbers.time(name + "_usual_time", usual.ray_ns / other.ray_ns,
                 fixed(usual.ray_ns / other.ray_ns, 2));
}

}  // namespace

void print_nesting(const NestingMeasurements& measured, bool times) {
    print_heading("Spheres on spheres, level by level");
    growth_table(measured.levels).print();
    if (times) {
        print_heading("Millions of rays per second");
        speeds_table(measured.levels).print();
        print_heading("Kilobytes");
        bytes_table(measured.levels).print();
        print_heading("Rays with another triangle than the exact one, or with a hit for a miss");
        differences_table(measured.levels).print();
    }
    print_heading("Large scenes");
    large_table(measured.large, times).table().print();
}

void quote_nesting(const NestingMeasurements& measured, bool times, Numbers& numbers) {
    numbers.count_table("nesting", growth_table(measured.levels));
    const NestingPoint& last = measured.levels.back();
    numbers.count("nesting_rays", last.rays);
    numbers.count("nesting_most", last.triangles);
    numbers.count("nesting_most_levels", measured.levels.size() - 1);
    numbers.count("nesting_most_instances", last.instances);
    const NestingTrace& usual = *last.by(nesting_way::usual);
    numbers.count("nesting_most_usual", usual.other_answer());
    const double bits = double(usual.differing()) / double(last.hits);
    numbers.count("nesting_most_usual_bits", bits, percent(bits));
    numbers.count("nesting_most_kilobytes", (last.traces.front().bytes + 500) / 1000);
    numbers.count_table("nesting_large", large_table(measured.large, false).table());
    for (const NestingPoint& p : measured.large) {
        const std::string name = "nesting_" + p.scene.substr(0, p.scene.find(':'));
        numbers.count(name + "_triangles", p.triangles);
        numbers.count(name + "_instances", p.instances);
        numbers.count(name + "_megabytes", double(p.traces.front().bytes) * 1e-6,
                      fixed(double(p.traces.front().bytes) * 1e-6, 1));
    }
    if (!times) return;
    numbers.time_table("nesting_speeds", speeds_table(measured.levels));
    numbers.time_table("nesting_bytes", bytes_table(measured.levels));
    numbers.time_table("nesting_differences", differences_table(measured.levels));
    numbers.time_table("nesting_large_speeds", large_table(measured.large, true).table());
    quote_beside(measured.levels, nesting_way::flattened, "nesting_flattened", numbers);
    quote_beside(measured.levels, nesting_way::embree, "nesting_embree", numbers);
    const double first = measured.levels.front().traces.front().ray_ns,
                 most = last.traces.front().ray_ns;
    numbers.time("nesting_slower", most / first, fixed(most / first, 1));
}

std::uint64_t wrong_nesting(const NestingMeasurements& measured) {
    std::uint64_t wrong = 0;
    for (const auto* points : {&measured.levels, &measured.large})
        for (const NestingPoint& p : *points)
            if (const NestingTrace* const flat = p.by(nesting_way::flattened))
                wrong += flat->differing();
    return wrong;
}

namespace {

template <class Value>
std::vector<Series> series_by_way(const std::vector<NestingPoint>& points, const Value& value) {
    std::vector<Series> all;
    for (const std::string_view way : all_ways) {
        Series series{.name = std::string(way), .x = {}, .y = {}};
        for (const NestingPoint& p : points)
            if (const NestingTrace* const trace = p.by(way)) {
                series.x.push_back(double(p.triangles));
                series.y.push_back(value(*trace));
            }
        if (!series.x.empty()) all.push_back(std::move(series));
    }
    return all;
}

}  // namespace

Chart nesting_memory_chart(const NestingMeasurements& measured) {
    Chart chart{.title = "Memory against triangles, for the nested sphereflake",
                .x_label = "triangles",
                .y_label = "memory, bytes",
                .log_x = true,
                .log_y = true,
                .series = series_by_way(measured.levels, [](const NestingTrace& trace) {
                    return double(trace.bytes);
                })};
    // Both ways through instances walk the same trees.
    std::erase_if(chart.series, [](const Series& s) { return s.name == nesting_way::usual; });
    return chart;
}

Chart nesting_speed_chart(const NestingMeasurements& measured) {
    return {.title = "Rays per second against triangles, for the nested sphereflake",
            .x_label = "triangles",
            .y_label = "millions of rays per second",
            .log_x = true,
            .log_y = true,
            .series = series_by_way(measured.levels, mega_rays)};
}

}  // namespace space::ch09
