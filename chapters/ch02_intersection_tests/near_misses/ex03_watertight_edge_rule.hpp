/// @file
/// Exercise 2.3, a near miss: points on horizontal edges belong to no triangle.
#pragma once

#include "common/geometry.hpp"

namespace space {

/// Twice the area of p q r: positive if r lies to the left of p -> q.
inline float edge(const Point2& p, const Point2& q, const Point2& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

inline bool owns(const Point2& a, const Point2& b, const Point2& c, const Point2& point) {
    const auto inside = [&](const Point2& p, const Point2& q) {
        const float side = edge(p, q, point);
        return side > 0.0f || (side == 0.0f && q.y < p.y);
    };
    return inside(a, b) && inside(b, c) && inside(c, a);
}

}  // namespace space
