/// @file
/// Exercise 3.5, solution.
#pragma once

#include "common/geometry.hpp"

namespace space {

inline Point3 cut(const Point3& p, const Point3& q, const Vector3& normal, float offset) {
    const float at_p = glm::dot(normal, p) - offset, at_q = glm::dot(normal, q) - offset;
    if (at_p > 0.0f) return cut(q, p, normal, offset);
    return p + at_p / (at_p - at_q) * (q - p);
}

}  // namespace space
