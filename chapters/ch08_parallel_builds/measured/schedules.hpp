/// @file
/// Builds recorded as graphs of tasks, simulated on up to 256 cores and held against measured ones:
/// claims P9 to P12, P14 and P17.
#pragma once

#include "chapters/ch08_parallel_builds/measured/schedule_data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <vector>

namespace space::ch08 {

ScheduleMeasurements measure_schedules(const Options& options);
void print_schedules(const ScheduleMeasurements& measured, bool times);
void quote_schedules(const ScheduleMeasurements& measured, bool times, Numbers& numbers);
/// P9 to P12, P14 and P17.
std::vector<ClaimAnswer> answer_schedules(const ScheduleMeasurements& measured);

/// Gains of all methods on up to 256 cores, of one scene.
Chart far_chart(const ScheduleMeasurements& measured, std::string_view scene);
/// Who worked when, in measured builds of one scene.
std::vector<BusyTime> measure_busy_times(const Options& options);
Chart busy_chart(const std::vector<BusyTime>& busy);

}  // namespace space::ch08
