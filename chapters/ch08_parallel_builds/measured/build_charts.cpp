#include "chapters/ch08_parallel_builds/measured/build_series.hpp"
#include "chapters/ch08_parallel_builds/measured/builds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace space::ch08 {

Chart gains_chart(const std::vector<BuildPoint>& scenes) {
    Chart chart{.title = "How much sooner the tree stands with two threads, by scene and method",
                .x_label = "scene",
                .y_label = "sequential time / time with 2 threads",
                .kind = ChartKind::bars,
                .series = {},
                .categories = scenes_of(scenes)};
    for (const std::string_view method : {symmetric, asymmetric, by_queue, ours}) {
        Series series{.name = std::string(method), .x = {}, .y = {}};
        for (const std::string& scene : chart.categories) {
            series.x.push_back(double(series.x.size()));
            series.y.push_back(point_of(scenes, scene, method, 2)->gain.median);
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

Chart quality_chart(const std::vector<BuildPoint>& scenes) {
    Chart chart{.title = "Build time against the expected cost of a ray, by builder",
                .x_label = "build time, sequential = 1",
                .y_label = "expected cost of a ray, binned = 1",
                .log_x = true,
                .kind = ChartKind::points,
                .series = {}};
    Series one{.name = "1 thread", .x = {}, .y = {}}, two{.name = "2 threads", .x = {}, .y = {}};
    for (const QualityPoint& p : qualities(scenes)) {
        Series& series = p.threads == 1 ? one : two;
        const bool is_same_tree = p.method == symmetric || p.method == asymmetric ||
                                  p.method == by_queue || p.method == ours;
        // One tree: with one thread the sequential builder stands for all, with two these two.
        if (p.threads == 1 && (is_same_tree || p.method == parallel_morton)) continue;
        if (p.method == symmetric || p.method == asymmetric) continue;
        series.x.push_back(p.time);
        series.y.push_back(p.cost);
        series.labels.emplace_back(p.method);
    }
    chart.series = {std::move(one), std::move(two)};
    return chart;
}

Chart build_growth_chart(const std::vector<BuildPoint>& growth) {
    Chart chart{.title = "Build time against the number of triangles, with one and two threads",
                .x_label = "triangles",
                .y_label = "build time in ms",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const auto& [name, method, threads] : {std::tuple{"sequential", sequential, 1u},
                                                {"ours, 1 thread", ours, 1u},
                                                {"ours, 2 threads", ours, 2u},
                                                {"queue, 2 threads", by_queue, 2u}}) {
        Series series{.name = name, .x = {}, .y = {}};
        for (const BuildPoint& p : growth) {
            if (p.method != method || p.threads != threads) continue;
            series.x.push_back(double(p.n));
            series.y.push_back(p.ms.median);
        }
        if (series.x.size() > 1)
            series.note = fmt::format("slope {:.2f}", growth_slope(growth, method, threads));
        chart.series.push_back(std::move(series));
    }
    return chart;
}

}  // namespace space::ch08
