/// @file
/// Exact corners as rational numbers, for those few who need more than a side: exact areas, exact
/// hits.
#pragma once

#include "chapters/ch03_bsp_trees/exact_corner.hpp"

#include <gmpxx.h>

#include <array>

namespace space {

/// In scene units.
std::array<mpq_class, 3> exact_point(const Meet<3>& meet);

}  // namespace space
