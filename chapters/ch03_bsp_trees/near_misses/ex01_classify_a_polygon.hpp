/// @file
/// Exercise 3.1, a near miss: looks for an edge with its ends on different sides, and so overlooks
/// a polygon that the plane cuts through two of its corners.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <span>

namespace space {

inline Side classify(std::span<const Point3> polygon, const SplitPlane<3>& plane) {
    Side side = Side::on;
    double before = plane.distance(DoublePoint<3>(polygon.back()));
    for (const Point3& corner : polygon) {
        const double distance = plane.distance(DoublePoint<3>(corner));
        if (before * distance < 0.0) return Side::across;
        if (distance != 0.0) side = distance > 0.0 ? Side::front : Side::back;
        before = distance;
    }
    return side;
}

}  // namespace space
