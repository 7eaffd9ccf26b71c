/// @file
/// Exercise 6.1: The quadrant of a point
/// Difficulty 1 of 3, about 20 minutes.
///
/// A quadtree's cells are half-open: what lies on the border of two cells belongs to the upper one,
/// on each axis. Only the root's own upper borders belong to the cells below them, since nothing is
/// above. So each point of the closed root is in exactly one cell at each depth. Say in which
/// quadrant of `cell` the point is, or that it is not in the cell at all. In the number of a
/// quadrant bit 0 is set for the upper half in *x*, bit 1 for the upper half in *y*. The point has
/// float coordinates; the corners and the centres of all cells are exact as doubles. Your answer is
/// to be exact, too: on a border, one float beside it, and very near to 0. What is not a number is
/// in no cell. Do it without `OrthtreeFrame` and its `cell_of`.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"

#include <cstdint>
#include <optional>

namespace space {

/// `cell` is the root or one of the cells below it.
inline std::optional<std::uint32_t> quadrant_of(const OrthtreeBox<2>& /*root*/,
                                                const OrthtreeBox<2>& /*cell*/,
                                                const Point2& /*point*/) {
    // TODO: this puts all points into one quadrant
    return 0;
}

}  // namespace space
