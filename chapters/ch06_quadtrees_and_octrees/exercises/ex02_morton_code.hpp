/// @file
/// Exercise 6.2: The Morton code
/// Difficulty 2 of 3, about 30 minutes.
///
/// An octree's root is the cube from (0, 0, 0) to (1, 1, 1). At depth 21 it has 2^21 cells on each
/// axis, half-open as in exercise 6.1: a point between two cells is in the upper one, and a point
/// with *x* = 1 is in the last one. The code of a point is the place of its cell, with the bits of
/// the axes by turns: bit *i* of the place on axis *a* is bit 3 *i* + *a* of the code. So three
/// bits are the number of a child, and the first three of 63 say what a walk from the root does
/// first. Points whose codes begin with the same children are in one cell: say also at which depth
/// the smallest cell is that has the points of both codes; where the codes are equal it is 21. Do
/// it without the chapter's headers.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace space {

/// The point is in the closed cube from 0 to 1.
inline std::uint64_t morton_code_of(const Point3& point) {
    // TODO: this is the order of the pixels of a picture: row by row, layer by layer
    const auto place = [](float p) { return static_cast<std::uint64_t>(p * 0x1p20f); };
    return place(point.x) | place(point.y) << 21 | place(point.z) << 42;
}

inline int common_depth(std::uint64_t /*a*/, std::uint64_t /*b*/) {
    // TODO: all points are in the root; and what else do the codes tell?
    return 0;
}

}  // namespace space
