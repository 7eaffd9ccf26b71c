/// @file
/// Exercise 2.6, a near miss: counts the roundings of the products and of the last difference,
/// and forgets that the coordinates' differences are rounded as well.
#pragma once

#include "common/geometry.hpp"

namespace space {

template <class Exact>
int orientation(const Point2& a, const Point2& b, const Point2& c, const Exact& exact) {
    const float left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x);
    const float determinant = left - right;
    const float bound = 2 * 0x1p-24f * (std::abs(left) + std::abs(right));
    if (determinant > bound) return 1;
    if (determinant < -bound) return -1;
    return exact(a, b, c);
}

}  // namespace space
