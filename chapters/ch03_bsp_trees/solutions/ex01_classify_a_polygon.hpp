/// @file
/// Exercise 3.1, solution.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <span>

namespace space {

inline PlaneSide classify(std::span<const Point3> polygon, const SplitPlane<3>& plane) {
    bool front = false, back = false;
    for (const Point3& corner : polygon) {
        const double distance = plane.distance(Double3(corner));
        front = front || distance > 0.0;
        back = back || distance < 0.0;
    }
    return front && back ? PlaneSide::straddling
           : front       ? PlaneSide::front
           : back        ? PlaneSide::back
                         : PlaneSide::coplanar;
}

}  // namespace space
