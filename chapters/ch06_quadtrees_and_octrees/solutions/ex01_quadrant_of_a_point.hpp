/// @file
/// Exercise 6.1, our answer.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"

#include <cstdint>
#include <optional>

namespace space {

/// `cell` is the root or one of the cells below it.
inline std::optional<std::uint32_t> quadrant_of(const OrthtreeBox<2>& root,
                                                const OrthtreeBox<2>& cell, const Point2& point) {
    const Double2 centre = cell.centre();
    std::uint32_t quadrant = 0;
    for (int axis = 0; axis < 2; ++axis) {
        const double p = point[axis];
        const bool on_roots_border = p == cell.max[axis] && p == root.max[axis];
        if (!(cell.min[axis] <= p && (p < cell.max[axis] || on_roots_border))) return std::nullopt;
        if (p >= centre[axis]) quadrant |= 1u << axis;
    }
    return quadrant;
}

}  // namespace space
