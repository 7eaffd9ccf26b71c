/// @file
/// Placements and their inverses, drift, normals, winding: claims O6 and O7.
#pragma once

#include "chapters/ch09_instancing_and_motion/measured/transform_data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <cstdint>
#include <vector>

namespace space::ch09 {

TransformMeasurements measure_transforms(const Options& options);

void print_transforms(const TransformMeasurements& measured, bool times);
void quote_transforms(const TransformMeasurements& measured, bool times, Numbers& numbers);
/// Sides taken for the other one, with the determinant's sign.
std::uint64_t wrong_transforms(const TransformMeasurements& measured);
/// O6 and O7.
std::vector<ClaimAnswer> answer_transforms(const TransformMeasurements& measured);

}  // namespace space::ch09
