/// @file
/// Exercise 2.6, solution.
#pragma once

#include "common/geometry.hpp"

namespace space {

/// Each product has three factors of 1 +- u24 behind it, two differences' and its own: it is off by
/// at most 3 u24 (1 + 2 u24) times itself. The last difference is rounded and keeps its sign,
/// unless it is 0. So 3 u24 (|left| + |right|) and a few u24 of it, for this sum's, this product's
/// and the last difference's roundings, bound the error: 4 u24 is on the safe side (Shewchuk 1997
/// has 3 u24 + 16 u24^2).
template <class Exact>
int orientation(const Point2& a, const Point2& b, const Point2& c, const Exact& exact) {
    const float left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
    const float determinant = left - right;
    const float bound = 4 * 0x1p-24f * (std::abs(left) + std::abs(right));
    if (determinant > bound) return 1;
    if (determinant < -bound) return -1;
    return exact(a, b, c);
}

}  // namespace space
