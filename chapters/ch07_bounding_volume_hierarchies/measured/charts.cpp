#include "chapters/ch07_bounding_volume_hierarchies/measured/outcome.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <ranges>
#include <utility>

namespace space::ch07 {
namespace {

/// The median over the scenes of one builder's value over the binned one's.
template <class Value>
double beside_bins(const std::vector<TreePoint>& trees, std::string_view builder,
                   const Value& value) {
    std::vector<double> ratios;
    for (const TreePoint& p : trees)
        if (p.builder == builder)
            ratios.push_back(value(p) / value(*tree_of(trees, p.scene, by_bins)));
    return median(std::move(ratios));
}

}  // namespace

Chart pareto_chart(const std::vector<TreePoint>& trees) {
    Chart chart{.title = "Build time against rays per second, by builder",
                .x_label = "build time, binned = 1",
                .y_label = "diffuse rays per second, binned = 1",
                .log_x = true,
                .log_y = true,
                .kind = ChartKind::points,
                .series = {}};
    const auto add = [&](std::string name, std::initializer_list<std::string_view> builders) {
        Series series{.name = std::move(name), .x = {}, .y = {}};
        for (const std::string_view builder : builders) {
            series.x.push_back(beside_bins(trees, builder, build_ms));
            series.y.push_back(beside_bins(
                trees, builder, [](const TreePoint& p) { return p.diffuse().per_second(); }));
            series.labels.emplace_back(builder);
        }
        chart.series.push_back(std::move(series));
    };
    add("this chapter's", {by_median, by_middle, by_morton, by_bins, by_sweep, by_spatial,
                           by_bottom_up, by_optimiser, by_bsp});
    add("Embree's", {embree, embree_high});
    return chart;
}

Chart peers_chart(const std::vector<TreePoint>& trees) {
    Chart chart{.title = "Diffuse rays per second beside Embree's, by scene",
                .x_label = "scene",
                .y_label = "diffuse rays per second, Embree = 1",
                .kind = ChartKind::bars,
                .series = {}};
    for (const Target& target : targets(trees)) chart.categories.push_back(target.scene);
    for (const std::string_view builder : {by_median, by_bins, by_spatial, bins_float})
        chart.add_bars(builder, [&](const std::string& scene) {
            return tree_of(trees, scene, builder)->diffuse().per_second() /
                   tree_of(trees, scene, embree)->diffuse().per_second();
        });
    return chart;
}

Chart growth_chart(const std::vector<TreePoint>& growth) {
    Chart chart{.title = "Build time against the number of triangles",
                .x_label = "triangles",
                .y_label = "build time in ms",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string_view builder : {by_morton, by_median, by_bins, by_sweep})
        chart.series.push_back(with_slope(series_along(
            std::string(builder), grown(growth, "soup", builder), &TreePoint::n, build_ms)));
    return chart;
}

Chart steps_chart(const std::vector<TreePoint>& growth) {
    Chart chart{.title =
                    "Nodes visited and triangles tested per diffuse ray against the number of "
                    "triangles",
                .x_label = "triangles",
                .y_label = "per ray",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string& scene : scenes_of(growth)) {
        const std::vector<TreePoint> points = grown(growth, scene, by_bins);
        const auto add = [&](std::string_view what, const auto& value) {
            chart.series.push_back(with_slope(
                series_along(fmt::format("{}, {}", scene, what), points, &TreePoint::n, value)));
        };
        add("nodes", diffuse_nodes);
        add("tests", diffuse_tests);
    }
    return chart;
}

Chart leaves_chart(const std::vector<LeafPoint>& leaves) {
    Chart chart{.title = "Time of a ray against the nodes per triangle, by the rule for leaves",
                .x_label = "nodes per triangle",
                .y_label = "ns per diffuse ray",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string& scene : scenes_of(leaves)) {
        Series series{.name = scene, .x = {}, .y = {}};
        for (const LeafPoint& p : leaves | std::views::reverse) {  // the name is at the right
            if (p.scene != scene || p.builder != by_bins) continue;
            series.x.push_back(p.nodes_per_triangle());
            series.y.push_back(p.ns_per_ray());
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

Chart accuracy_chart(const std::vector<AccuracyPoint>& accuracy) {
    constexpr double none = 0.3;  // where a logarithmic axis shows that there is none
    Chart chart{.title = "Time of a ray against wrong answers, by box test and triangle test",
                .x_label = "time per ray, conservative and exact = 1",
                .y_label = "wrong answers per million aimed rays; below 1: none",
                .log_y = true,
                .kind = ChartKind::points,
                .series = {}};
    std::map<std::string, double> careful_ms;
    for (const AccuracyPoint& p : accuracy)
        if (p.margins == conservative && p.test == exact_test) careful_ms[p.scene] = p.ms;
    for (const std::string_view margins : {conservative, plain})
        for (const std::string_view test : {exact_test, watertight_test, float_test}) {
            const std::string_view brief = test == exact_test   ? "exact"
                                           : test == float_test ? "float"
                                                                : test;
            Series series{
                .name = fmt::format("{}, {}", margins == plain ? "plain" : "margins", brief),
                .x = {},
                .y = {}};
            for (const AccuracyPoint& p : accuracy) {
                if (p.margins != margins || p.test != test) continue;
                series.x.push_back(p.ms / careful_ms[p.scene]);
                series.y.push_back(p.wrong > 0 ? p.wrong_per_million() : none);
            }
            chart.series.push_back(std::move(series));
        }
    return chart;
}

}  // namespace space::ch07
