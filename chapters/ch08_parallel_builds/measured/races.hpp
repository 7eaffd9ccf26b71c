/// @file
/// The race for a shared scratch in many schedules: claim P16.
#pragma once

#include "chapters/ch08_parallel_builds/measured/race_data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <vector>

namespace space::ch08 {

std::vector<RacePoint> measure_races(const Options& options);
void print_races(const std::vector<RacePoint>& races);
void quote_races(const std::vector<RacePoint>& races, Numbers& numbers);
/// P16.
std::vector<ClaimAnswer> answer_races(const std::vector<RacePoint>& races);

}  // namespace space::ch08
