/// @file
/// Exercise 6.4: The cell of a loose tree
/// Difficulty 2 of 3, about 30 minutes.
///
/// In a loose octree a cell reaches beyond its faces: with looseness 2 by half of its edge on every
/// side. So no search has to find out where a triangle is stored; its size says how deep, and its
/// place says in which cell. The size is the longest edge of the triangle's box. The depth is the
/// greatest, 21 at most, at which the edges of cells are not shorter than that. The cell is the one
/// at this depth in which the centre of the box lies; cells are half-open as in exercise 6.1. (Why
/// does the cell, as far as it reaches, always hold the triangle? The check asks for that, too.)
/// The root is the cube from (0, 0, 0) to (`edge`, `edge`, `edge`), where `edge` is a power of two,
/// and holds the triangle. Your answer is to be exact: the triangle has float coordinates, but the
/// size and the centre of its box need not be floats. Do it without `OrthtreeFrame`.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace space {

inline OrthtreeCell<3> loose_cell_of(const Triangle& /*triangle*/, float /*edge*/) {
    // TODO: the root holds every triangle, but then every ray has to test them all
    return {};
}

}  // namespace space
