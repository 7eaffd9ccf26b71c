/// @file
/// Exercise 2.3, solution.
#pragma once

#include "common/geometry.hpp"

namespace space {

/// Twice the area of p q r: positive if r lies to the left of p -> q.
inline float edge(const Point2& p, const Point2& q, const Point2& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

/// Counter-clockwise, left edges run downwards and lower ones to the right. The neighbour sees the
/// edge reversed: exactly one of the two says yes.
inline bool keeps_its_points(const Point2& p, const Point2& q) {
    return q.y < p.y || (q.y == p.y && q.x > p.x);
}

inline bool owns(const Point2& a, const Point2& b, const Point2& c, const Point2& point) {
    const auto inside = [&](const Point2& p, const Point2& q) {
        const float side = edge(p, q, point);
        return side > 0.0f || (side == 0.0f && keeps_its_points(p, q));
    };
    return inside(a, b) && inside(b, c) && inside(c, a);
}

}  // namespace space
