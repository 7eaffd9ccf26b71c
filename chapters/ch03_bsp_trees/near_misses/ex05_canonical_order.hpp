/// @file
/// Exercise 3.5, a near miss: computes in double and snaps the point to a grid, as programs do that
/// "weld" corners. Where the exact cut is halfway between two places of the grid, the neighbours
/// snap to either side.
#pragma once

#include "common/geometry.hpp"

#include <glm/common.hpp>

namespace space {

inline Point3 cut(const Point3& p, const Point3& q, const Vector3& normal, float offset) {
    const Double3 a(p), b(q), n(normal);
    const double at_p = glm::dot(n, a) - offset, at_q = glm::dot(n, b) - offset;
    return Point3(glm::round((a + at_p / (at_p - at_q) * (b - a)) * 0x1p20) / 0x1p20);
}

}  // namespace space
