/// @file
/// Exercise 2.5: A conservative box margin
/// Difficulty 3 of 3, about 30 minutes.
///
/// A ray that touches a corner of a box enters and leaves it at the same *t*; three roundings can
/// put `near` behind `far`, and a tree that asks this test loses the triangle inside. Widen the
/// interval by a bound on the roundings, so that the test never says no where exact arithmetic says
/// yes, and not by more than it takes: rays that pass at a thousandth of the box's size are still
/// missed. *t* >= 0 here, and no numbers near the ends of the float range.
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
        leave = far < leave ? far : leave;
    }
    return enter <= leave;  // TODO: three roundings lie behind each end
}

}  // namespace space
