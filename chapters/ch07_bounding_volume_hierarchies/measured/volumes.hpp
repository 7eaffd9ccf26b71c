/// @file
/// How tight bounding volumes are around parts of scenes, and what a test costs: claims H11, H12.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/measured/volume_data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <vector>

namespace space::ch07 {

VolumeMeasurements measure_volumes(const Options& options);

void print_volumes(const VolumeMeasurements& measured, bool times);
/// H11 and H12.
std::vector<ClaimAnswer> answer_volumes(const VolumeMeasurements& measured);
void quote_volumes(const VolumeMeasurements& measured, bool times, Numbers& numbers);

}  // namespace space::ch07
