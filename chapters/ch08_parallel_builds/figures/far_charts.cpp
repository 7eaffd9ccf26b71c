#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/measured/schedules.hpp"
#include "common/measure.hpp"

namespace space::ch08 {
namespace {

/// Of the recorded scenes the one whose root is cut most evenly, or least.
Chart chart_of(const ScheduleMeasurements& measured, bool even) {
    const GraphPoint* chosen = nullptr;
    for (const GraphPoint& graph : measured.graphs)
        if (!chosen || (graph.larger_share < chosen->larger_share) == even) chosen = &graph;
    return far_chart(measured, chosen ? chosen->scene : "");
}

}  // namespace

Chart fig_08_13(const Options& options) {
    return chart_of(measured_once<measure_schedules>(options), true);
}

Chart fig_08_14(const Options& options) {
    return chart_of(measured_once<measure_schedules>(options), false);
}

Chart fig_08_12(const Options& options) {
    return busy_chart(measured_once<measure_busy_times>(options));
}

}  // namespace space::ch08
