#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space::ch06 {
namespace {

/// Enough digits for a few pixels of a picture: "0.004 %".
std::string share_of(double share) {
    return share > 0.0 && share < 0.001 ? fmt::format("{:.3f} %", 100.0 * share) : percent(share);
}

/// No wrong pixel at all has no place on a logarithmic axis: it is drawn here, in %, below one
/// pixel of the largest picture.
constexpr double no_wrong_pixel = 1e-4;

/// Which pictures a table has.
using Chosen = bool (*)(const AdaptivePoint& point);

std::vector<std::string> counts(const AdaptivePoint& p) {
    return {share_of(p.ray_share()), with_commas(p.cells), with_commas(p.other),
            with_commas(p.wrong), with_commas(std::uint64_t(p.largest))};
}
const std::vector<std::string> count_headings{"rays, of all pixels", "cells", "pixels not the same",
                                              "off by more than 8", "largest error"};

Table counts_table(const std::vector<AdaptivePoint>& points, std::vector<std::string> names,
                   Chosen chosen, std::vector<std::string> (*name)(const AdaptivePoint&)) {
    names.insert(names.end(), count_headings.begin(), count_headings.end());
    Table table(names);
    for (const AdaptivePoint& p : points) {
        if (!chosen(p)) continue;
        std::vector<std::string> row = name(p), rest = counts(p);
        row.insert(row.end(), rest.begin(), rest.end());
        table.row(row);
    }
    return table;
}

/// All scenes by all rules.
Table rules_table(const std::vector<AdaptivePoint>& points) {
    return counts_table(
        points, {"scene", "cells are judged by"},
        [](const AdaptivePoint& p) { return p.is_usual(); },
        [](const AdaptivePoint& p) {
            return std::vector<std::string>{p.scene, std::string(p.rule)};
        });
}

/// The first scene, with other thresholds or with other first cells.
std::vector<AdaptivePoint> of_first_scene(const std::vector<AdaptivePoint>& points) {
    std::vector<AdaptivePoint> first;
    for (const AdaptivePoint& p : points)
        if (p.scene == points.front().scene && (p.rule == by_objects || p.rule == by_all_samples))
            first.push_back(p);
    std::ranges::stable_sort(first, {}, &AdaptivePoint::rule);
    return first;
}
Table thresholds_table(const std::vector<AdaptivePoint>& points) {
    return counts_table(
        of_first_scene(points), {"threshold", "cells are judged by"},
        [](const AdaptivePoint& p) { return p.first_cell == AdaptivePoint::usual_first_cell; },
        [](const AdaptivePoint& p) {
            return std::vector<std::string>{std::to_string(p.threshold), std::string(p.rule)};
        });
}
Table first_cells_table(const std::vector<AdaptivePoint>& points) {
    std::vector<AdaptivePoint> sorted = of_first_scene(points);
    std::ranges::stable_sort(sorted, {}, &AdaptivePoint::first_cell);
    std::ranges::stable_sort(sorted, {}, &AdaptivePoint::rule);
    return counts_table(
        sorted, {"first cell", "cells are judged by"},
        [](const AdaptivePoint& p) { return p.threshold == AdaptivePoint::usual_threshold; },
        [](const AdaptivePoint& p) {
            return std::vector<std::string>{fmt::format("{0} x {0}", p.first_cell),
                                            std::string(p.rule)};
        });
}

Table times_table(const std::vector<AdaptivePoint>& points) {
    Table table({"scene", "cells are judged by", "all pixels, ms", "adaptive, ms", "time", "rays",
                 "off by more than 8"});
    for (const AdaptivePoint& p : points)
        if (p.is_usual())
            table.row({p.scene, std::string(p.rule), fixed(p.full_ms, 1), fixed(p.ms, 1),
                       percent(p.time_share()), share_of(p.ray_share()),
                       share_of(p.wrong_share())});
    return table;
}

}  // namespace

Chart adaptive_chart(const std::vector<AdaptivePoint>& points) {
    Chart chart{.title =
                    "Time of a picture of the room against its wrong pixels, for thresholds "
                    "from 2 to 32 of 255 steps",
                .x_label = "time, in % of the full picture's",
                .y_label = "pixels off by more than 8 of 255 steps, in %; lowest: none",
                .log_y = true,
                .kind = ChartKind::points,
                .series = {}};
    for (const std::string_view rule : {by_colors, by_objects, by_all_samples}) {
        Series series{.name = std::string(rule), .x = {}, .y = {}};
        for (const AdaptivePoint& p : points) {
            if (p.scene != points.front().scene || p.rule != rule ||
                p.first_cell != AdaptivePoint::usual_first_cell)
                continue;
            series.x.push_back(100.0 * p.time_share());
            series.y.push_back(p.wrong > 0 ? 100.0 * p.wrong_share() : no_wrong_pixel);
            series.labels.push_back(std::to_string(p.threshold));
        }
        chart.series.push_back(series);
    }
    return chart;
}

void print_adaptive(const std::vector<AdaptivePoint>& points, bool times) {
    print_heading("Adaptive sampling: pictures of some of their pixels");
    rules_table(points).print();
    print_heading("With other thresholds");
    thresholds_table(points).print();
    print_heading("With other first cells");
    first_cells_table(points).print();
    if (!times) return;
    print_heading("and times, on one thread");
    times_table(points).print();
}

void quote_adaptive(const std::vector<AdaptivePoint>& points, bool times, Numbers& numbers) {
    numbers.count_table("adaptive_rules", rules_table(points));
    numbers.count_table("adaptive_thresholds", thresholds_table(points));
    numbers.count_table("adaptive_first_cells", first_cells_table(points));
    for (const AdaptivePoint& p : points) {
        if (p.scene != points.front().scene || !p.is_usual()) continue;
        const std::string name = p.rule == by_colors        ? "adaptive_colors_"
                                 : p.rule == by_objects     ? "adaptive_objects_"
                                 : p.rule == by_all_samples ? "adaptive_all_samples_"
                                                            : "adaptive_triangles_";
        numbers.count(name + "rays", p.ray_share(), share_of(p.ray_share()));
        numbers.count(name + "wrong", p.wrong);
        numbers.count(name + "largest", std::uint64_t(p.largest));
        if (times) numbers.time(name + "time", p.time_share(), percent(p.time_share()));
    }
    if (times) numbers.time_table("adaptive_times", times_table(points));
}

}  // namespace space::ch06
