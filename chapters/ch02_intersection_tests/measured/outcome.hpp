/// @file
/// What is made of chapter 2's measurements: tables, charts, verdicts, and what the text quotes.
#pragma once

#include "chapters/ch02_intersection_tests/measured/data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/results.hpp"

namespace space::ch02 {

Chart triangle_chart(
    const Measurements& measured);  ///< fig_02_03: ns per test against leaks and wrong decisions
Chart box_chart(const Measurements& measured);  ///< fig_02_07: ns per test against boxes missed
Chart sphere_chart(
    const Measurements& measured);  ///< fig_02_09: wrong decisions against the distance, and ns
Chart root_chart(const Measurements& measured);  ///< fig_02_11: ns per root against the worst error

/// The answers to L1 L2 L3 L4 L5 L8 L9 O4 O5 O12 O13 H15.
std::vector<ClaimAnswer> answer_claims(const Measurements& measured);

/// Tables on the terminal.
void print_triangles(
    const Measurements& measured);  ///< one row for each input, one column for each test
void print_signs(const Measurements& measured);
void print_roots(const Measurements& measured);
void print_boxes_and_spheres(const Measurements& measured);
void print_bounces(const Measurements& measured);
void print_times(const Measurements& measured);

/// What the text quotes; times where there are any.
Numbers quoted(const Measurements& measured);

}  // namespace space::ch02
