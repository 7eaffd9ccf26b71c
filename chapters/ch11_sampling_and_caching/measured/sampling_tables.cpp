#include "chapters/ch11_sampling_and_caching/measured/sampling.hpp"
#include "common/measure.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace space::ch11 {
namespace {

/// The different values of a field, in the order in which they come.
template <class Point, class Field>
std::vector<std::string> different_names(const std::vector<Point>& points, Field Point::*field) {
    std::vector<std::string> names;
    for (const Point& p : points)
        if (std::ranges::find(names, std::string(p.*field)) == names.end())
            names.emplace_back(p.*field);
    return names;
}

std::vector<PatternPoint> points_of(const std::vector<PatternPoint>& all,
                                    const std::string& integrand, const std::string& pattern) {
    std::vector<PatternPoint> some;
    for (const PatternPoint& p : all)
        if (p.integrand == integrand && p.pattern == pattern) some.push_back(p);
    return some;
}
double pattern_slope(const std::vector<PatternPoint>& points) {
    std::vector<double> x, y;
    for (const PatternPoint& p : points) {
        x.push_back(double(p.samples));
        y.push_back(p.error);
    }
    return log_log_slope(x, y);
}

Table patterns_table(const std::vector<PatternPoint>& all) {
    Table table(
        {"irradiance", "pattern", "first samples", "error", "last samples", "error", "slope"});
    for (const std::string& integrand : different_names(all, &PatternPoint::integrand))
        for (const std::string& pattern : different_names(all, &PatternPoint::pattern)) {
            const std::vector<PatternPoint> points = points_of(all, integrand, pattern);
            table.row({integrand, pattern, with_commas(points.front().samples),
                       fmt::format("{:.2g} %", 100.0 * points.front().error),
                       with_commas(points.back().samples),
                       fmt::format("{:.2g} %", 100.0 * points.back().error),
                       fixed(pattern_slope(points), 2)});
        }
    return table;
}

/// The next power of ten above.
std::string below_power(double error) {
    if (error == 0.0) return "0";
    return fmt::format("{:.0e}", std::pow(10.0, std::ceil(std::log10(error))));
}
Table spherical_triangles_table(const std::vector<SphericalTrianglePoint>& points) {
    Table table({"size at distance 1", "error by three angles, below", "by the volume, below"});
    for (const SphericalTrianglePoint& p : points)
        table.row(
            {fmt::format("{:.0e}", p.size), below_power(p.by_angles), below_power(p.by_volume)});
    return table;
}

Table path_work_table(const std::vector<PathWorkPoint>& points) {
    Table table({"scene", "path rays a sample", "shadow rays a sample"});
    for (const PathWorkPoint& p : points)
        table.row({p.scene, fixed(double(p.path_rays) / double(p.samples), 2),
                   fixed(double(p.shadow_rays) / double(p.samples), 2)});
    return table;
}

Table references_table(const std::vector<ReferencePoint>& points) {
    Table table({"exact value of", "", "by", "mean", "standard error", "off by so many"});
    for (const ReferencePoint& p : points)
        table.row({p.what, fixed(p.exact, 4), p.estimator, fixed(p.mean, 4), fixed(p.error, 4),
                   fixed(p.deviation(), 1)});
    return table;
}

const LightingPoint& lighting_of(const std::vector<LightingPoint>& points, const std::string& scene,
                                 const std::string& lighting) {
    return *std::ranges::find_if(
        points, [&](const LightingPoint& p) { return p.scene == scene && p.lighting == lighting; });
}
double over_uniform(const std::vector<LightingPoint>& points, const LightingPoint& point) {
    return point.efficiency() / lighting_of(points, point.scene, "uniform").efficiency();
}
std::string times_text(double ratio) {
    return ratio >= 99.5 ? with_commas(static_cast<std::uint64_t>(ratio + 0.5))
                         : fmt::format("{:.2g}", ratio);
}

/// A line for each scene, a column for each way.
template <class Value>
Table by_lighting(const std::vector<LightingPoint>& points, const Value& value) {
    const std::vector<std::string> ways = different_names(points, &LightingPoint::lighting);
    std::vector<std::string> headings{"scene"};
    headings.insert(headings.end(), ways.begin(), ways.end());
    Table table(headings);
    for (const std::string& scene : different_names(points, &LightingPoint::scene)) {
        std::vector<std::string> row{scene};
        for (const std::string& way : ways) row.push_back(value(lighting_of(points, scene, way)));
        table.row(row);
    }
    return table;
}
Table variance_table(const std::vector<LightingPoint>& points) {
    return by_lighting(points,
                       [&](const LightingPoint& p) { return times_text(over_uniform(points, p)); });
}

/// Ways whose mean differs from that of cosine-weighted directions by more than five standard
/// errors of the difference.
std::uint64_t different_means(const std::vector<LightingPoint>& points) {
    std::uint64_t different = 0;
    for (const LightingPoint& p : points) {
        const LightingPoint& cosine = lighting_of(points, p.scene, "cosine");
        different +=
            std::abs(p.mean - cosine.mean) > 5.0 * std::hypot(p.mean_error, cosine.mean_error);
    }
    return different;
}

}  // namespace

SamplingMeasurements measure_sampling(const Options& options) {
    return {.patterns = measure_patterns(options),
            .spherical_triangles = measure_spherical_triangles(options),
            .lightings = options.counts ? std::vector<LightingPoint>{} : measure_lightings(options),
            .path_work = measure_path_work(options),
            .references = measure_references(options)};
}

void print_sampling(const SamplingMeasurements& measured, bool times) {
    print_heading("Estimators beside exact values");
    references_table(measured.references).print();
    print_heading("Error by number of samples");
    patterns_table(measured.patterns).print();
    print_heading("Rays of a path");
    path_work_table(measured.path_work).print();
    if (!times) return;
    print_heading("Solid angles of triangles: largest relative error");
    spherical_triangles_table(measured.spherical_triangles).print();
    print_heading("Variance of a sample, over the mean squared");
    by_lighting(measured.lightings, [](const LightingPoint& p) {
        return fmt::format("{:.3g}", p.variance);
    }).print();
    print_heading("Nanoseconds of a sample");
    by_lighting(measured.lightings, [](const LightingPoint& p) { return fixed(p.ns, 0); }).print();
    print_heading("Efficiency, 1 / (variance x time); uniform directions = 1");
    variance_table(measured.lightings).print();
}

void quote_sampling(const SamplingMeasurements& measured, bool times, Numbers& numbers) {
    numbers.count_table("references", references_table(measured.references));
    numbers.count_table("patterns", patterns_table(measured.patterns));
    numbers.count_table("path_work", path_work_table(measured.path_work));
    if (!times) return;
    numbers.time_table("variance", variance_table(measured.lightings));
    // What rounding does hangs on the library's functions.
    numbers.time_table("spherical_triangles",
                       spherical_triangles_table(measured.spherical_triangles));
}

std::uint64_t wrong_sampling(const SamplingMeasurements& measured, bool times) {
    std::uint64_t wrong = times ? different_means(measured.lightings) : 0;
    for (const ReferencePoint& p : measured.references) wrong += !p.agrees();
    return wrong;
}

std::vector<ClaimAnswer> answer_sampling(const SamplingMeasurements& measured) {
    const std::vector<LightingPoint>& points = measured.lightings;
    if (points.empty()) return {};
    std::size_t agree = 0, all = 0;
    std::vector<std::string> losers, best;
    for (const std::string& scene : different_names(points, &LightingPoint::scene)) {
        const LightingPoint* winner = nullptr;
        for (const LightingPoint& p : points) {
            if (p.scene != scene || p.lighting == "uniform") continue;
            ++all;
            const double gain = over_uniform(points, p);
            agree += gain > 1.0;
            if (gain <= 1.0)
                losers.push_back(fmt::format("{} ({}) {}", p.lighting, scene, times_text(gain)));
            if (!winner || p.efficiency() > winner->efficiency()) winner = &p;
        }
        best.push_back(fmt::format("{}: {} {} times", scene, winner->lighting,
                                   times_text(over_uniform(points, *winner))));
    }
    return {{.claim = "O1",
             .verdict = verdict_of(agree, all),
             .measured = fmt::format(
                 "efficiency over uniform directions: {} of {} ways and scenes gain; best {}{}{}",
                 agree, all, joined(best), losers.empty() ? "" : "; not: ", joined(losers)),
             .scene = joined(different_names(points, &LightingPoint::scene)),
             .rule = "1 / (variance x time) above that of uniform directions, for each way and "
                     "scene"}};
}

Chart patterns_chart(const std::vector<PatternPoint>& patterns) {
    Chart chart{.title = "Error of an irradiance against the number of samples, by pattern",
                .x_label = "samples",
                .y_label = "relative error",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string& integrand : different_names(patterns, &PatternPoint::integrand))
        for (const std::string& pattern : different_names(patterns, &PatternPoint::pattern))
            chart.series.push_back(with_slope(
                series_along(pattern + ", " + integrand, points_of(patterns, integrand, pattern),
                             &PatternPoint::samples, &PatternPoint::error)));
    return chart;
}

Chart lightings_chart(const std::vector<LightingPoint>& lightings) {
    Chart chart{.title = "Efficiency of ways to look for light, uniform directions = 1",
                .x_label = "",
                .y_label = "efficiency, uniform directions = 1",
                .log_y = true,
                .kind = ChartKind::bars,
                .series = {},
                .categories = different_names(lightings, &LightingPoint::scene)};
    for (const std::string& way : different_names(lightings, &LightingPoint::lighting))
        if (way != "uniform")
            chart.add_bars(way, [&](const std::string& scene) {
                return over_uniform(lightings, lighting_of(lightings, scene, way));
            });
    return chart;
}

}  // namespace space::ch11
