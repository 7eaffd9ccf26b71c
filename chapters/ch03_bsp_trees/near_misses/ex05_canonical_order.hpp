/// @file
/// Exercise 3.5, a near miss: begins at the nearer end, but with an s that was measured from the
/// end that came first; 1 - s is not what the neighbour divides out.
#pragma once

#include "common/geometry.hpp"

namespace space {

inline Point3 cut(const Point3& p, const Point3& q, const Vector3& normal, float offset) {
    const float at_p = glm::dot(normal, p) - offset, at_q = glm::dot(normal, q) - offset;
    const float s = at_p / (at_p - at_q);
    return s <= 0.5f ? p + s * (q - p) : q + (1.0f - s) * (p - q);
}

}  // namespace space
