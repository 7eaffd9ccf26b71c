/// @file
/// Exercise 10.4, our answer.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
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
    Grid grid{.origin = node.min, .exponent = {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int i = int(axis);
        const double extent = double{node.max[i]} - double{node.min[i]};
        int& exponent = grid.exponent[axis];
        exponent = std::max(-148, std::ilogb(extent / 255.0)) - 1;  // a guess, never too large
        while (plane(grid, axis, 255) < node.max[i]) ++exponent;
    }
    return grid;
}

inline PackedBox pack(const Grid& grid, const Aabb& child) {
    PackedBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        unsigned lower = 255, upper = 0;
        while (plane(grid, axis, lower) > child.min[int(axis)]) --lower;
        while (plane(grid, axis, upper) < child.max[int(axis)]) ++upper;
        box.lower[axis] = std::uint8_t(lower);
        box.upper[axis] = std::uint8_t(upper);
    }
    return box;
}

}  // namespace space
