/// @file
/// Exercise 2.2, solution.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace space {

inline bool hits_box(const Ray& ray, const Aabb& box) {
    const Vector3 inverse = 1.0f / ray.direction;
    float enter = ray.tmin, leave = ray.tmax;
    for (int axis = 0; axis < 3; ++axis) {
        const bool backwards = std::signbit(inverse[axis]);
        const float near =
            ((backwards ? box.max : box.min)[axis] - ray.origin[axis]) * inverse[axis];
        const float far =
            ((backwards ? box.min : box.max)[axis] - ray.origin[axis]) * inverse[axis];
        enter = near > enter ? near : enter;  // false for what is not a number: enter stays
        leave = far < leave ? far : leave;
    }
    return enter <= leave;
}

}  // namespace space
