/// @file
/// Exercise 6.1, a near miss: how far the point is above the cell's corner is compared with half of
/// the edge. Near to 0 that difference is rounded: -10^-30 is 1 above -1, and so in the upper half.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"

#include <cstdint>
#include <optional>

namespace space {

/// `cell` is the root or one of the cells below it.
inline std::optional<std::uint32_t> quadrant_of(const OrthtreeBox<2>& root,
                                                const OrthtreeBox<2>& cell, const Point2& point) {
    std::uint32_t quadrant = 0;
    for (int axis = 0; axis < 2; ++axis) {
        const double edge = cell.max[axis] - cell.min[axis];
        const double above = double{point[axis]} - cell.min[axis];
        const bool on_roots_border = above == edge && cell.max[axis] == root.max[axis];
        if (!(0.0 <= above && (above < edge || on_roots_border))) return std::nullopt;
        if (above >= 0.5 * edge) quadrant |= 1u << axis;
    }
    return quadrant;
}

}  // namespace space
