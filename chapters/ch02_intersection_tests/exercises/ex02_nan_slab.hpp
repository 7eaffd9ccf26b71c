/// @file
/// Exercise 2.2: The NaN slab
/// Difficulty 2 of 3, about 20 minutes.
///
/// A ray that runs in the plane of a box's face has a direction component of zero and an origin on
/// the slab: 0 times infinity is not a number, and the comparison after it goes astray. The stub
/// loses such rays. Make it right for every ray whose numbers are small and whole, with 0 and -0
/// among the direction's components: the box is closed. A ray that runs beside a face misses, even
/// if only by the last bit. No case of its own for zero is needed.
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
        // TODO: what do min and max return when one of a and b is not a number?
        enter = std::max(std::min(a, b), enter);
        leave = std::min(std::max(a, b), leave);
    }
    return enter <= leave;
}

}  // namespace space
