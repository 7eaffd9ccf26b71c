/// @file
/// What the terminal and the text show of the comparison, and what it answers to the sources.
#pragma once

#include "chapters/ch12_comparison/measured/comparison_data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/report.hpp"
#include "common/program/results.hpp"

#include <cstdint>
#include <vector>

namespace space::ch12 {

/// The work behind a ray in each of the book's structures, over the smallest size of each scene
/// that needs no file: counts alone, the same on every machine.
Table work_table(const Comparison& comparison);

/// The tables of a full run that a reader wants to see at once.
void print_comparison(const Comparison& comparison, bool times);

/// All that the text quotes. Without times only what is counted.
void quote_comparison(const Comparison& comparison, bool times, Numbers& numbers);

/// The tables of it.
void quote_tables(const Comparison& comparison, bool times, Numbers& numbers);

/// O14.
std::vector<ClaimAnswer> answer_comparison(const Comparison& comparison);

/// How often a structure of the book answered otherwise than exact arithmetic does.
std::uint64_t wrong_answers(const Comparison& comparison, bool of_peers = false);

}  // namespace space::ch12
