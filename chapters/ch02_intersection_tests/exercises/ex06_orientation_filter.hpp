/// @file
/// Exercise 2.6: A filter for the orientation
/// Difficulty 3 of 3, about 40 minutes.
///
/// Does the way from *a* over *b* to *c* turn to the left (1), to the right (-1) or not at all (0)?
/// The sign of a determinant tells, but in floats it is wrong for some points that nearly lie on a
/// line. `exact(a, b, c)` always tells right, and takes ten times as long. Derive by how much the
/// computed determinant can be off, in terms of `|left| + |right|` and the unit roundoff *u24* =
/// 2^-24; return its sign where that is certain, and ask `exact` where it is not. Where the
/// determinant is larger than `16 u24 (|left| + |right|)` nothing must be asked. No number is near
/// the ends of the float range.
#pragma once

#include "common/geometry.hpp"

namespace space {

template <class Exact>
int orientation(const Point2& a, const Point2& b, const Point2& c, const Exact& exact) {
    const float left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
    const float determinant = left - right;
    // TODO: when is this sign certain?
    static_cast<void>(exact);
    return determinant > 0.0f ? 1 : determinant < 0.0f ? -1 : 0;
}

}  // namespace space
