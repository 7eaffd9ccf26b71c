/// @file
/// Exercise 2.3: A watertight edge rule
/// Difficulty 2 of 3, about 25 minutes.
///
/// A point on the common edge of two triangles belongs to both if triangles are closed, and the
/// picture paints it twice; it belongs to none if they are open, and the picture has a hole. Give
/// each point of a triangulated region to exactly one triangle: a point on an edge belongs to the
/// triangle for which the edge is a left edge or a horizontal lower edge (any such rule does).
/// Triangles are counter-clockwise, coordinates whole and from -1,000 to 1,000: the edge functions
/// are exact. A point inside a triangle is its own, however thin it is.
#pragma once

#include "common/geometry.hpp"

namespace space {

/// Twice the area of p q r: positive if r lies to the left of p -> q.
inline float edge(const Point2& p, const Point2& q, const Point2& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

inline bool owns(const Point2& a, const Point2& b, const Point2& c, const Point2& point) {
    // TODO: a point on an edge belongs to both of the triangles there
    return edge(a, b, point) >= 0.0f && edge(b, c, point) >= 0.0f && edge(c, a, point) >= 0.0f;
}

}  // namespace space
