/// @file
/// How chapter 4 counts and times searches among points, beside nanoflann's.
#pragma once

#include "chapters/ch04_kd_trees/measured/point_data.hpp"
#include "common/geometry.hpp"
#include "common/pcg32.hpp"
#include "common/program/options.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace space::ch04 {

/// How the points of a set, and the queries of it, lie in the unit square or cube: evenly, or in
/// sqrt(n) clusters about 0.01 wide.
enum class Places { uniform, clustered };

template <int D>
std::vector<Point<D>> make_points(Places places, std::size_t points, std::size_t count,
                                  Pcg32& random);

/// The k nearest for k = 1, 8, 64 in sets of 10^3 points and more: up to 10^7, with --quick 10^5.
std::vector<PointSet> measure_point_searches(const Options& options);

}  // namespace space::ch04
