/// @file
/// What chapter 2 measured, as tables on the terminal.
#pragma once

#include "chapters/ch02_intersection_tests/measured/measurements.hpp"

namespace space::ch02 {

void print_triangles(
    const Measurements& measured);  ///< one row for each input, one column for each test
void print_roots(const Measurements& measured);
void print_boxes_and_spheres(const Measurements& measured);
void print_bounces(const Measurements& measured);
void print_times(const Measurements& measured);

}  // namespace space::ch02
