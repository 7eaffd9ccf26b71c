#include "chapters/ch05_lazy_kd_trees/measured/outcome.hpp"

#include <fmt/format.h>

namespace space::ch05 {
namespace {

/// An error of zero has no place on a logarithmic axis: it is drawn here, below all that are not.
constexpr double no_error = 1e-5;

}  // namespace

Chart reach_chart(const std::vector<ReachPoint>& reach) {
    Chart chart{.title = "Time to build and to trace against the share of nodes that rays reach",
                .x_label = "nodes that are made, in % of all",
                .y_label = "time to build and to trace in ms",
                .series = {}};
    Series eager{.name = "eager", .x = {}, .y = {}}, lazy{.name = "lazy", .x = {}, .y = {}};
    for (const ReachPoint& point : reach) {
        eager.x.push_back(100.0 * point.node_share());
        eager.y.push_back(point.eager_ms);
        lazy.x.push_back(100.0 * point.node_share());
        lazy.y.push_back(point.lazy_ms);
    }
    chart.series = {eager, lazy};
    return chart;
}

Chart memory_chart(const std::vector<MemoryPoint>& memory) {
    Chart chart{.title = "Memory that the trees hold while a picture is drawn, row by row",
                .x_label = "rows that are drawn, in % of the picture",
                .y_label = "MB held",
                .series = {}};
    Series eager{.name = "eager", .x = {}, .y = {}}, lazy{.name = "lazy", .x = {}, .y = {}};
    for (const MemoryPoint& point : memory) {
        eager.x.push_back(100.0 * point.picture);
        eager.y.push_back(1e-6 * double(point.eager_bytes));
        lazy.x.push_back(100.0 * point.picture);
        lazy.y.push_back(1e-6 * double(point.lazy_bytes));
    }
    chart.series = {eager, lazy};
    return chart;
}

Chart first_picture_chart(const std::vector<FirstPicture>& pictures) {
    Chart chart{.title = "Time to the first picture of a subdivided ball against its error",
                .x_label = "time to the first picture in ms",
                .y_label = "mean error of t, relative; lowest: none",
                .log_x = true,
                .log_y = true,
                .kind = ChartKind::points,
                .series = {}};
    Series eager{.name = "eager, coarser and coarser", .x = {}, .y = {}},
        lazy{.name = "lazy", .x = {}, .y = {}};
    for (const FirstPicture& picture : pictures) {
        Series& series = picture.way == "lazy" ? lazy : eager;
        series.x.push_back(picture.ms);
        series.y.push_back(picture.error > 0.0 ? picture.error : no_error);
        series.labels.push_back(fmt::format("{} levels", picture.levels));
    }
    chart.series = {eager, lazy};
    return chart;
}

}  // namespace space::ch05
