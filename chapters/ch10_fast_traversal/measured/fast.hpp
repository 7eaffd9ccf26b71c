/// @file
/// All that chapter 10 measures, its tables and what its pages quote.
#pragma once

#include "chapters/ch10_fast_traversal/measured/data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"

#include <cstdint>

namespace space::ch10 {

FastMeasurements measure_fast(const Options& options);

void print_fast(const FastMeasurements& measured, bool times);
void quote_fast(const FastMeasurements& measured, bool times, Numbers& numbers);
/// Answers that are not exact arithmetic's, of trees that promise it.
std::uint64_t wrong_answers(const FastMeasurements& measured);

}  // namespace space::ch10
