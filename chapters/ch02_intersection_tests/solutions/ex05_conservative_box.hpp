/// @file
/// Exercise 2.5, solution.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace space {

/// Difference, reciprocal and product are rounded, each by a factor of 1 +- u24, u24 = 2^-24; so is
/// the product with this factor. near is at most (1 + u24)^3 times the exact one, far at least (1 -
/// u24)^4 (1 + 8 u24) > (1 + u24)^3 times.
inline constexpr float lengthen = 1.0f + 8.0f * 0x1p-24f;

inline bool may_hit_box(const Ray& ray, const Aabb& box) {
    const Vector3 inverse = 1.0f / ray.direction;
    float enter = ray.tmin, leave = ray.tmax;
    for (int axis = 0; axis < 3; ++axis) {
        const bool backwards = std::signbit(inverse[axis]);
        const float near =
            ((backwards ? box.max : box.min)[axis] - ray.origin[axis]) * inverse[axis];
        const float far =
            ((backwards ? box.min : box.max)[axis] - ray.origin[axis]) * inverse[axis];
        enter = near > enter ? near : enter;
        const float beyond = far * lengthen;
        leave = beyond < leave ? beyond : leave;
    }
    return enter <= leave;
}

}  // namespace space
