#include "chapters/ch02_intersection_tests/measured/outcome.hpp"
#include "common/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace space::ch02 {
namespace {

/// Zero has no place on a logarithmic axis: "none" is drawn here, below everything that was
/// counted.
constexpr double none = 0.1;
double on_log_axis(double per_million) {
    return std::max(per_million, none);
}

double over_scenes(const std::vector<SceneTimes>& scenes, std::size_t test) {
    std::vector<double> ns;
    for (const SceneTimes& scene : scenes) ns.push_back(scene.tests[test].ns);
    return median(ns);
}

}  // namespace

Chart triangle_chart(const Measurements& measured) {
    Series leaks{.name = "leaks", .x = {}, .y = {}};
    const Leaks& mesh = measured.leaks.front();
    const std::vector<Timed>& tests = measured.triangle_times.front().tests;
    for (std::size_t test = 0; test < tests.size(); ++test) {
        leaks.x.push_back(over_scenes(measured.triangle_times, test));
        leaks.y.push_back(on_log_axis(1e6 * static_cast<double>(mesh.leaks[test]) /
                                      static_cast<double>(mesh.rays)));
        leaks.labels.push_back(tests[test].test);
    }
    return {.title =
                "Nanoseconds per ray-triangle test against leaks through the edges and vertices of "
                "a closed mesh",
            .x_label = "ns per test (median of six inputs)",
            .y_label = "leaks per million rays; 0.1 stands for none",
            .log_x = true,
            .log_y = true,
            .kind = ChartKind::points,
            .series = {leaks}};
}

Chart root_chart(const Measurements& measured) {
    Chart chart{.title =
                    "Nanoseconds per square root against the worst error, for 0 to 4 rounds of "
                    "Newton's method",
                .x_label = "ns per root; labels: rounds of Newton's method",
                .y_label = "worst error in units in the last place",
                .log_x = true,
                .log_y = true,
                .kind = ChartKind::points,
                .series = {}};
    const auto add = [&](Series& series, const std::string& time_of, const std::string& error_of,
                         const std::string& label) {
        for (const TimedRoot& timed : measured.root_times)
            for (const RootAccuracy& root : measured.roots)
                if (timed.test == time_of && root.name == error_of) {
                    series.x.push_back(timed.ns);
                    series.y.push_back(root.worst_binades);
                    series.labels.push_back(label);
                }
    };
    for (const auto& [name, time_of, error_of] : {std::array{"Newton", "Newton ", "Newton "},
                                                  {"four at once", "vector type ", "Newton "},
                                                  {"reciprocal", "reciprocal ", "reciprocal "}}) {
        Series series{.name = name, .x = {}, .y = {}};
        for (int rounds = 0; rounds <= 4; ++rounds)
            add(series, time_of + std::to_string(rounds), error_of + std::to_string(rounds),
                std::to_string(rounds));
        chart.series.push_back(series);
    }
    Series processor{.name = "processor", .x = {}, .y = {}};
    add(processor, "std::sqrt", "library", "sqrt");
    add(processor, "four by the processor", "library", "four sqrt");
    add(processor, "estimate 0", "estimate 0", "estimate");
    chart.series.push_back(processor);
    return chart;
}

Chart box_chart(const Measurements& measured) {
    Series missed{.name = "missed", .x = {}, .y = {}};
    for (const Timed& timed : measured.pattern_times.back().boxes) {
        if (timed.test == "as printed") continue;  // it misses what it was told to miss
        for (const Wrong& wrong : measured.boxes.wrong)
            if (wrong.test == timed.test) {
                missed.x.push_back(timed.ns);
                missed.y.push_back(on_log_axis(1e6 * static_cast<double>(wrong.misses) /
                                               static_cast<double>(measured.boxes.exact_hits)));
                missed.labels.push_back(timed.test);
            }
    }
    return {.title =
                "Nanoseconds per ray-box test against boxes that are missed although they are hit, "
                "at corners, edges and faces",
            .x_label = "ns per test (hits that nobody can predict)",
            .y_label = "missed per million hits; 0.1 stands for none",
            .log_y = true,
            .kind = ChartKind::points,
            .series = {missed}};
}

Chart sphere_chart(const Measurements& measured) {
    Chart chart{
        .title =
            "Wrong decisions about a sphere of radius 1 against the distance of the ray's origin",
        .x_label = "distance in radii",
        .y_label = "wrong per million; 0.1 stands for none",
        .log_x = true,
        .log_y = true,
        .series = {}};
    for (std::size_t test = 0; test < sphere_tests_measured; ++test) {
        const Timed& timed = measured.sphere_times[test];
        Series series{
            .name = timed.test, .x = {}, .y = {}, .note = fmt::format("{:.1f} ns", timed.ns)};
        for (const SphereAccuracy& sphere : measured.spheres) {
            series.x.push_back(sphere.distance);
            series.y.push_back(on_log_axis(sphere.wrong[test].per_million()));
        }
        chart.series.push_back(series);
    }
    return chart;
}

}  // namespace space::ch02
