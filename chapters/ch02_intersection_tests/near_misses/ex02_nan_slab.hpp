/// @file
/// Exercise 2.2, a near miss: std::fmin and std::fmax pass over what is not a number, and then both
/// ends of the slab are the same infinity.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace space {

inline bool hits_box(const Ray& ray, const Aabb& box) {
    const Vector3 inverse = 1.0f / ray.direction;
    float enter = ray.tmin, leave = ray.tmax;
    for (int axis = 0; axis < 3; ++axis) {
        const float a = (box.min[axis] - ray.origin[axis]) * inverse[axis];
        const float b = (box.max[axis] - ray.origin[axis]) * inverse[axis];
        enter = std::fmax(std::fmin(a, b), enter);
        leave = std::fmin(std::fmax(a, b), leave);
    }
    return enter <= leave;
}

}  // namespace space
