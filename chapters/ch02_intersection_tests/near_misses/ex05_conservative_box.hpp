/// @file
/// Exercise 2.5, a near miss: 1 + 4 u24, the factor of many public programs, is too little for
/// three roundings at either end; but one ray in very many shows it.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace space {

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
        leave = far * 1.00000024f < leave ? far * 1.00000024f : leave;
    }
    return enter <= leave;
}

}  // namespace space
