#include "chapters/ch01_naive_ray_tracing/measured/outcome.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space::ch01 {

void print_counts(const std::vector<SceneCounts>& all) {
    print_heading(
        "Tests per pixel, hits that Algorithm 1 as printed leaves, hits lost to what is behind");
    Table tests({"scene", "triangles", "lights", "pixels", "hits", "as printed", "in reverse",
                 "behind", "shadow rays", "occluded", "tests", "per pixel"});
    for (const SceneCounts& s : all)
        tests.row({s.scene, with_commas(s.triangles), with_commas(s.lights), with_commas(s.pixels),
                   with_commas(s.hits), with_commas(s.hits_as_printed),
                   with_commas(s.hits_in_reverse), with_commas(s.behind_wins),
                   with_commas(s.shadow_rays), with_commas(s.occluded), with_commas(s.tests),
                   with_commas(s.tests / s.pixels)});
    tests.print();

    print_heading("Ray tracer and rasteriser: pixels in which they see different triangles");
    Table coverage(
        {"scene", "pixels", "covered", "differ", "near an edge", "same depth", "unexplained"});
    for (const SceneCounts& s : all)
        coverage.row({s.scene, with_commas(s.pixels), with_commas(s.covered),
                      with_commas(s.disagree), with_commas(s.near_edge), with_commas(s.same_depth),
                      with_commas(s.unexplained)});
    coverage.print();
}

void print_times(const std::vector<GrowthPoint>& growth, const std::vector<SharePoint>& shares) {
    print_heading("Time per pixel against triangles (one thread, medians of interleaved runs)");
    Table times({"scene", "triangles", "naive, µs", "rasteriser, µs", "ratio"});
    for (const GrowthPoint& point : growth)
        times.row({point.scene, with_commas(std::uint64_t(point.triangles)),
                   fmt::format("{:.1f}", point.naive_us),
                   fmt::format("{:.4f}", point.rasteriser_us),
                   fmt::format("{:.0f}", point.naive_us / point.rasteriser_us)});
    times.print();

    print_heading("Share of the time spent in intersection tests");
    Table share({"scene", "triangles", "tests, ms", "the rest, ms", "share of the tests"});
    for (const SharePoint& point : shares)
        share.row({point.scene, with_commas(std::uint64_t(point.triangles)),
                   fmt::format("{:.2f}", point.tests_ms), fmt::format("{:.4f}", point.rest_ms),
                   fmt::format("{:.4f} %", 100 * point.share())});
    share.print();
}

Numbers quoted(const Measurements& measured) {
    Numbers numbers;
    const VertexLeaks& leaks = measured.leaks;
    const auto part = [&](std::uint64_t count) { return double(count) / double(leaks.rays); };
    numbers.count("vertex_rays", leaks.rays);
    numbers.count("exact_rays", leaks.exact);
    numbers.count("leaks_float", part(leaks.leaks_float), one_in(part(leaks.leaks_float)));
    numbers.count("leaks_double", part(leaks.leaks_double), one_in(part(leaks.leaks_double)));
    numbers.count("exact_leaks", leaks.exact_leaks_double);
    numbers.count("other_leaks", leaks.leaks_double - leaks.exact_leaks_double);

    for (const std::string scene : {"soup", "icosphere"}) {
        const std::vector<GrowthPoint> points = of_scene(measured.growth, scene);
        if (points.size() < 2) continue;
        const auto factor = [&](std::size_t to) {
            return points[to].rasteriser_us / points[to - 1].rasteriser_us;
        };
        const double first = factor(1), last = factor(points.size() - 1);
        numbers.time("rasteriser_first_" + scene, first, fmt::format("{:.1f}", first));
        numbers.time("rasteriser_last_" + scene, last, fmt::format("{:.1f}", last));
    }
    std::vector<double> tests, rest;
    for (const std::string& scene : scenes_of(measured.shares)) {
        const ShareSlopes slope = share_slopes(measured.shares, scene);
        tests.push_back(slope.tests);
        rest.push_back(slope.rest);
    }
    const auto range = [&](const std::string& name, const std::vector<double>& slope) {
        if (slope.empty()) return;
        const auto [least, most] = std::minmax_element(slope.begin(), slope.end());
        numbers.time(name + "_least", *least, fmt::format("{:.2f}", *least));
        numbers.time(name + "_most", *most, fmt::format("{:.2f}", *most));
    };
    range("tests_slope", tests);
    range("rest_slope", rest);
    return numbers;
}

}  // namespace space::ch01
