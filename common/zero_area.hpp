/// @file
/// Triangles that are none: corners on one line, or all at one point.
#pragma once

#include "common/geometry.hpp"

namespace space {

/// Whether a triangle of finite floats has exactly zero area, decided exactly.
bool has_zero_area(const Triangle& triangle);

}  // namespace space
