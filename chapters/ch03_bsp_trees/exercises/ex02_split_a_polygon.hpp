/// @file
/// Exercise 3.2: Split a polygon
/// Difficulty 2 of 3, about 30 minutes.
///
/// Cut a convex polygon that lies across a plane into its piece in front and its piece behind;
/// `plane.distance(corner)` is positive in front, 0 on the plane and negative behind. Both keep the
/// polygon's order of corners; which corner they begin with is up to you. A corner on the plane
/// goes to both pieces, once each, and so does the point where an edge passes through the plane.
/// Checked on every polygon made of some of ten corners, with numbers for which every cut is exact:
/// the pieces must have the right corners and no more, lie on their sides and have the polygon's
/// area; and on cuts at thirds and sevenths, which may be off by a float's rounding.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <span>
#include <vector>

namespace space {

struct Pieces {
    std::vector<Point3> front, back;
};

inline Pieces split(std::span<const Point3> polygon, const SplitPlane<3>& plane) {
    // TODO: both subtrees get the whole polygon; each should get its own piece
    static_cast<void>(plane);
    Pieces pieces;
    pieces.front.assign(polygon.begin(), polygon.end());
    pieces.back.assign(polygon.begin(), polygon.end());
    return pieces;
}

}  // namespace space
