/// @file
/// Exercise 10.4: Eight bits a plane
/// Difficulty 2 of 3, about 45 minutes.
///
/// Six floats for the box of each child are most of a node's memory. A compressed node has a grid
/// instead, the lower corner of its own box and a step for each axis that is a power of two, and a
/// child's box in six bytes that count steps. What a ray sees is not the box that was packed but
/// `plane(...)`, with the rounding of its sum; if that makes a box smaller anywhere, rays are lost.
///
/// `grid_of` is to begin at the node's lower corner and to take, for each axis, the smallest
/// exponent from -149 on for which the last plane, 255, reaches the node's upper one. `pack` is to
/// take the planes that are nearest to the child's box and not inside of it: the largest
/// `plane(...)` that is not above the lower corner, the smallest that is not below the upper one.
/// Where several bytes stand for the same float any of them will do.
///
/// Boxes are finite, and a child's lies in the node's. They may be flat, tiny, or as large as
/// floats allow, and far from the origin a step may be less than what a float can tell: the check
/// compares with all 256 planes, bit for bit.
#pragma once

#include "common/geometry.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace space {

/// Where the planes of a node's children may lie.
struct Grid {
    Point3 origin{0.0f};
    std::array<int, 3> exponent{};  ///< of the steps, which are powers of two
};

/// A box in steps of its node's grid.
struct PackedBox {
    std::array<std::uint8_t, 3> lower{}, upper{};
};

/// As a ray sees it. The product is exact, the sum is rounded.
inline float plane(const Grid& grid, std::size_t axis, unsigned steps) {
    return grid.origin[int(axis)] + std::ldexp(float(steps), grid.exponent[axis]);
}

inline Grid grid_of(const Aabb& node) {
    // TODO: steps of 2^121 reach across all boxes, and are hardly ever fine enough
    return {.origin = node.min, .exponent = {121, 121, 121}};
}

inline PackedBox pack(const Grid& grid, const Aabb& child) {
    // TODO: this box loses no ray, and rejects none
    static_cast<void>(grid);
    static_cast<void>(child);
    return {.lower = {0, 0, 0}, .upper = {255, 255, 255}};
}

}  // namespace space
