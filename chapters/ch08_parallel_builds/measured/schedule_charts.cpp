#include "chapters/ch08_parallel_builds/measured/build_data.hpp"
#include "chapters/ch08_parallel_builds/measured/schedules.hpp"

#include <fmt/format.h>

#include <array>

namespace space::ch08 {

Chart far_chart(const ScheduleMeasurements& measured, std::string_view scene) {
    Chart chart{.title = fmt::format("Simulated gain against cores, by method: {}", scene),
                .x_label = "cores",
                .y_label = "times faster than one core",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string_view method : {ours, by_queue, symmetric, asymmetric}) {
        Series series{std::string(method), {}, {}};
        for (const SimulatedPoint& point : measured.simulated)
            if (point.scene == scene && point.method == method && !point.has_bandwidth) {
                series.x.push_back(point.cores);
                series.y.push_back(point.gain);
            }
        chart.series.push_back(series);
    }
    Series limited{"ours, this memory", {}, {}};
    for (const SimulatedPoint& point : measured.simulated)
        if (point.scene == scene && point.method == ours && point.has_bandwidth) {
            limited.x.push_back(point.cores);
            limited.y.push_back(point.gain);
        }
    if (!limited.x.empty()) chart.series.push_back(limited);
    return chart;
}

}  // namespace space::ch08
