/// @file
/// Perfect splits (Havran & Bittner 2002, "On Improving KD-Trees for Ray Shooting"): the bounding
/// box of only that part of a polygon which lies in a cell.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace space {

/// A convex polygon while it is clipped, or a segment as a polygon with two corners.
template <int D>
struct ClippedPolygon {
    /// A half space adds one corner; where rounding has bent the polygon, one for every two corners
    /// at most: 3, 4, 6, 9, 13, 19, 28.
    std::array<Double<D>, 28> corners;
    std::size_t size = 0;

    void push_back(const Double<D>& corner) { corners.at(size++) = corner; }

    // [clipped]
    /// The part where sign * corner[axis] <= sign * position (Sutherland & Hodgman 1974).
    ClippedPolygon clipped(int axis, double position, double sign) const {
        ClippedPolygon part;
        for (std::size_t i = 0; i < size; ++i) {
            const Double<D>&from = corners[i], &to = corners[i + 1 == size ? 0 : i + 1];
            const double before = sign * (position - from[axis]),
                         after = sign * (position - to[axis]);
            if (before >= 0.0) part.push_back(from);
            if ((before < 0.0 && after > 0.0) || (before > 0.0 && after < 0.0)) {
                Double<D> cut =
                    from + (position - from[axis]) / (to[axis] - from[axis]) * (to - from);
                cut[axis] = position;
                part.push_back(cut);
            }
        }
        return part;
    }
    // [clipped]
};

/// The nearest floats that are not above and not below x.
inline float float_below(double x) {
    const auto nearest = static_cast<float>(x);
    return double{nearest} > x ? std::nextafter(nearest, -infinity) : nearest;
}
inline float float_above(double x) {
    return -float_below(-x);
}

// [clipped_bounds]
/// How far a clipped corner may be off on an axis where the polygon's coordinates go up to
/// `largest`, and how much wider each half space is made.
///
/// With u53 = 2^-53: a cut is from + s (to - from), 0 <= s <= 1. s carries three roundings, the
/// difference, the product and the sum one each: 11 u53 largest and terms with u53^2, less than 12
/// u53 largest; after 2 D cuts at most 2 D times that. Let each computed corner stand for the exact
/// point that the same s gives on the exact edge: these points span a convex part of the polygon's
/// plane. What a cut takes from it are ears, spanned by corners that were computed to lie outside
/// and by two cuts, all of them beyond the *wider* half space or on its plane, and so, exactly, not
/// inside the half space itself. Hence the exact part is never lost, also where a corner is outside
/// by rounding alone and an edge runs nearly along the plane: with half spaces as they are that
/// would take a long piece of the edge. What 12 leaves over pays for the roundings of the wider
/// planes and of this product.
template <int D>
double clipping_margin(double largest) {
    return 2 * D * 12.0 * 0x1p-53 * largest;
}

/// A box that holds what of the polygon lies in `cell`, but for roundings the smallest; empty where
/// there is nothing.
template <int D>
BasicAabb<D> clipped_bounds(const Simplex<D>& polygon, const BasicAabb<D>& cell) {
    ClippedPolygon<D> part;
    BasicAabb<D> bounds;
    for (int corner = 0; corner < D; ++corner) {
        part.push_back(Double<D>(polygon[corner]));
        bounds.extend(polygon[corner]);
    }
    Double<D> margin;
    for (int axis = 0; axis < D; ++axis)
        margin[axis] = clipping_margin<D>(
            std::max(std::abs(double{bounds.min[axis]}), std::abs(double{bounds.max[axis]})));
    for (int axis = 0; axis < D; ++axis) {
        if (bounds.min[axis] < cell.min[axis])
            part = part.clipped(axis, cell.min[axis] - margin[axis], -1.0);
        if (bounds.max[axis] > cell.max[axis])
            part = part.clipped(axis, cell.max[axis] + margin[axis], 1.0);
    }
    if (part.size == 0) return BasicAabb<D>::empty();
    Double<D> low = part.corners[0], high = part.corners[0];
    for (std::size_t i = 1; i < part.size; ++i) {
        low = glm::min(low, part.corners[i]);
        high = glm::max(high, part.corners[i]);
    }
    for (int axis = 0; axis < D; ++axis) {  // the polygon and the cell bound it, too, and exactly
        bounds.min[axis] =
            std::max({bounds.min[axis], cell.min[axis], float_below(low[axis] - margin[axis])});
        bounds.max[axis] =
            std::min({bounds.max[axis], cell.max[axis], float_above(high[axis] + margin[axis])});
    }
    return bounds;
}
// [clipped_bounds]

}  // namespace space
