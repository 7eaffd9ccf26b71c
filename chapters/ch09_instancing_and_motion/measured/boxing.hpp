/// @file
/// The inverse ray against boxes of turned boxes: claim O8.
#pragma once

#include "chapters/ch09_instancing_and_motion/measured/boxing_data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <cstdint>
#include <vector>

namespace space::ch09 {

BoxingMeasurements measure_boxing(const Options& options);

void print_boxing(const BoxingMeasurements& measured, bool times);
void quote_boxing(const BoxingMeasurements& measured, bool times, Numbers& numbers);
/// Answers of the ways that test world triangles, where they are not those of a tree anew.
std::uint64_t wrong_boxing(const BoxingMeasurements& measured);
/// O8.
std::vector<ClaimAnswer> answer_boxing(const BoxingMeasurements& measured);

}  // namespace space::ch09
