/// @file
/// Machines as cpuid describes them, and what locks cost: claim P13.
#pragma once

#include "chapters/ch08_parallel_builds/measured/machine_data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <vector>

namespace space::ch08 {

MachineMeasurements measure_machine(const Options& options);

void print_machine(const MachineMeasurements& measured, bool times);
/// P13.
std::vector<ClaimAnswer> answer_machine(const MachineMeasurements& measured);
void quote_machine(const MachineMeasurements& measured, bool times, Numbers& numbers);

}  // namespace space::ch08
