/// @file
/// Exercise 3.1, a near miss: looks for an edge with its ends on different sides, and so overlooks
/// a polygon that the plane cuts through two of its corners.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <span>

namespace space {

inline PlaneSide classify(std::span<const Point3> polygon, const SplitPlane<3>& plane) {
    PlaneSide side = PlaneSide::coplanar;
    double before = plane.distance(Double3(polygon.back()));
    for (const Point3& corner : polygon) {
        const double distance = plane.distance(Double3(corner));
        if (before * distance < 0.0) return PlaneSide::straddling;
        if (distance != 0.0) side = distance > 0.0 ? PlaneSide::front : PlaneSide::back;
        before = distance;
    }
    return side;
}

}  // namespace space
