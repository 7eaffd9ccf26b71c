/// @file
/// When workers believe that a build has ended: claim P15.
#pragma once

#include "chapters/ch08_parallel_builds/measured/ending_data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <vector>

namespace space::ch08 {

EndingMeasurements measure_endings(const Options& options);

void print_endings(const EndingMeasurements& measured, bool times);
/// P15.
std::vector<ClaimAnswer> answer_endings(const EndingMeasurements& measured);
void quote_endings(const EndingMeasurements& measured, bool times, Numbers& numbers);

}  // namespace space::ch08
