/// @file
/// The box of a transformed box, in three ways: by intervals (Arvo 1990, "Transforming axis-aligned
/// bounding boxes", Graphics Gems), from all eight corners, and from two, which is wrong.
#pragma once

#include "chapters/ch04_kd_trees/clipped_bounds.hpp"
#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace space {

// [rounded_outward]
/// Floats around a range of doubles. A bound beyond all floats is the largest of them: what is
/// outside of it is no finite float.
inline Aabb rounded_outward(const Double3& low, const Double3& high) {
    constexpr double largest = std::numeric_limits<float>::max();
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
        box.min[axis] = float_below(std::clamp(low[axis], -largest, largest));
        box.max[axis] = float_above(std::clamp(high[axis], -largest, largest));
    }
    return box;
}
// [rounded_outward]

// [transformed_box]
/// Holds M p for every point p of the box, in exact arithmetic and as flattening rounds it; and all
/// that is at most `beyond` farther out. By intervals (Arvo 1990): each entry of the matrix makes
/// its product smallest at one end of the box's axis, and the sums of the smallest and of the
/// largest products are the bounds.
///
/// Each has four roundings and one of the widening, so with u53 = 2^-53 it is off by at most 5 u53
/// times the sum of its terms' sizes, but for terms with u53^2, which 6 u53 covers. Flattening
/// computes the same sums in the same order from points of the box, and rounding keeps an order:
/// its corners are inside, and would be without any margin.
inline Aabb transformed_box(const Affine& m, const Aabb& box, const Double3& beyond = Double3(0)) {
    if (box.is_empty()) return {};
    Double3 low(0.0), high(0.0), size(0.0);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const double at_min = m.at(i, j) * box.min[j], at_max = m.at(i, j) * box.max[j];
            low[i] += std::min(at_min, at_max);
            high[i] += std::max(at_min, at_max);
            size[i] += std::max(std::abs(at_min), std::abs(at_max));
        }
    const Double3 by = m.translation();
    const Double3 off = 6.0 * 0x1p-53 * (size + glm::abs(by)) + beyond;
    return rounded_outward(low + by - off, high + by + off);
}
// [transformed_box]

/// From the eight corners: the same box but for roundings, with four times the products.
inline Aabb box_of_corners(const Affine& m, const Aabb& box) {
    if (box.is_empty()) return {};
    Double3 low(infinity), high(-infinity);
    for (int corner = 0; corner < 8; ++corner) {
        Double3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = (corner >> axis & 1 ? box.max : box.min)[axis];
        low = glm::min(low, m.point(p));
        high = glm::max(high, m.point(p));
    }
    return rounded_outward(low, high);
}

/// From the two corners that the box is stored by: wrong as soon as the map turns it.
inline Aabb box_of_two_corners(const Affine& m, const Aabb& box) {
    if (box.is_empty()) return {};
    const Double3 a = m.point(Double3(box.min)), b = m.point(Double3(box.max));
    return rounded_outward(glm::min(a, b), glm::max(a, b));
}

}  // namespace space
