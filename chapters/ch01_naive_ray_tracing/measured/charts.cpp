#include "chapters/ch01_naive_ray_tracing/measured/outcome.hpp"
#include "common/measure.hpp"

#include <fmt/format.h>

#include <span>

namespace space::ch01 {

Slopes slopes(const std::vector<GrowthPoint>& growth, const std::string& scene) {
    std::vector<double> triangles, naive, rasteriser;
    for (const GrowthPoint& point : of_scene(growth, scene)) {
        triangles.push_back(point.triangles);
        naive.push_back(point.naive_us);
        rasteriser.push_back(point.rasteriser_us);
    }
    const auto last_two = [](const std::vector<double>& v) { return std::span(v).last(2); };
    return {log_log_slope(triangles, naive), log_log_slope(triangles, rasteriser),
            log_log_slope(last_two(triangles), last_two(rasteriser))};
}

ShareSlopes share_slopes(const std::vector<SharePoint>& shares, const std::string& scene) {
    std::vector<double> triangles, tests, rest;
    for (const SharePoint& point : of_scene(shares, scene)) {
        triangles.push_back(point.triangles);
        tests.push_back(point.tests_ms);
        rest.push_back(point.rest_ms);
    }
    return {log_log_slope(triangles, tests), log_log_slope(triangles, rest)};
}

Chart growth_chart(const std::vector<GrowthPoint>& growth) {
    Chart chart{
        .title = "Time per pixel against the number of triangles, naive ray tracer and rasteriser",
        .x_label = "triangles",
        .y_label = "time per pixel in µs",
        .log_x = true,
        .log_y = true,
        .series = {}};
    for (const std::string scene : {"soup", "icosphere"}) {
        std::vector<double> triangles, naive, rasteriser;
        for (const GrowthPoint& point : of_scene(growth, scene)) {
            triangles.push_back(point.triangles);
            naive.push_back(point.naive_us);
            rasteriser.push_back(point.rasteriser_us);
        }
        const Slopes slope = slopes(growth, scene);
        chart.series.push_back({.name = "naive, " + scene,
                                .x = triangles,
                                .y = naive,
                                .note = fmt::format("slope {:.2f}", slope.naive)});
        chart.series.push_back(
            {.name = "rasteriser, " + scene,
             .x = triangles,
             .y = rasteriser,
             .note = fmt::format("slope at the end {:.2f}", slope.rasteriser_last)});
    }
    return chart;
}

Chart share_chart(const std::vector<SharePoint>& shares) {
    Chart chart{
        .title = "The part of the time that is not spent in intersection tests, against triangles",
        .x_label = "triangles",
        .y_label = "time not in intersection tests, %",
        .log_x = true,
        .log_y = true,
        .series = {}};
    for (const std::string& scene : scenes_of(shares)) {
        std::vector<double> triangles, percent;
        for (const SharePoint& point : of_scene(shares, scene)) {
            triangles.push_back(point.triangles);
            percent.push_back(100.0 * point.rest());
        }
        chart.series.push_back({.name = scene, .x = triangles, .y = percent});
    }
    return chart;
}

Chart accuracy_chart(const VertexLeaks& leaks) {
    const auto per_10000 = [&](std::uint64_t count) {
        return 1e4 * static_cast<double>(count) / static_cast<double>(leaks.rays);
    };
    return {.title = "Time and leaks of the same ray-triangle test in float and in double",
            .x_label = "rays of 10,000 aimed at vertices that slip through",
            .y_label = "time (double = 1)",
            .kind = ChartKind::points,
            .series = {{.name = "M\u00f6ller\u2013Trumbore",
                        .x = {per_10000(leaks.leaks_float), per_10000(leaks.leaks_double)},
                        .y = {leaks.float_ms / leaks.double_ms, 1.0},
                        .labels = {"float", "double"}}}};
}

}  // namespace space::ch01
