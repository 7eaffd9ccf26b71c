/// @file
/// Exercise 3.1: Classify a polygon
/// Difficulty 1 of 3, about 15 minutes.
///
/// On which side of a plane does a polygon lie? In front or behind, where no corner is on the other
/// side: it may touch the plane with a corner or an edge, it only must not cross it. On the plane
/// (coplanar), if all corners are; straddling it, if some corners are in front and some behind. The
/// polygon has three corners or more. Checked by hand-made cases, with corners close to the plane,
/// and by all polygons of up to five corners of a small set; `plane.distance(corner)` is exact for
/// all of them.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <span>

namespace space {

inline PlaneSide classify(std::span<const Point3> polygon, const SplitPlane<3>& plane) {
    // TODO: one corner does not tell where the others are
    const double distance = plane.distance(Double3(polygon[0]));
    return distance > 0.0   ? PlaneSide::front
           : distance < 0.0 ? PlaneSide::back
                            : PlaneSide::coplanar;
}

}  // namespace space
