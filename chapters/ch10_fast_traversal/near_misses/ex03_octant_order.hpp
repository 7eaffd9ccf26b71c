/// @file
/// Exercise 10.3, a near miss: the byte holds each child's place where it should hold each place's
/// child. Most orders of four are their own inverses, and then the two are one.
#pragma once

#include "common/geometry.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace space {

/// A cut that went into a node, with what is on its sides: 0 to 3 is that child, 4 and above the
/// cut of the number 4 less.
struct Cut {
    int axis = 0;
    unsigned lower = 0, upper = 0;
};

inline unsigned octant_of(const Vector3& direction) {
    unsigned octant = 0;
    for (int axis = 0; axis < 3; ++axis) octant |= unsigned{std::signbit(direction[axis])} << axis;
    return octant;
}

/// The children of one side, near before far, from a place of the order on.
inline void append(std::span<const Cut> cuts, unsigned side, unsigned octant, std::uint8_t& order,
                   unsigned& place) {
    if (side < 4) {
        order = std::uint8_t(order | place++ << 2 * side);
        return;
    }
    const Cut& cut = cuts[side - 4];
    const bool down = (octant >> cut.axis & 1u) != 0;
    append(cuts, down ? cut.upper : cut.lower, octant, order, place);
    append(cuts, down ? cut.lower : cut.upper, octant, order, place);
}

/// The order for each octant. cuts[0] is the topmost; there are one to three.
inline std::array<std::uint8_t, 8> visit_orders(std::span<const Cut> cuts) {
    std::array<std::uint8_t, 8> orders{};
    for (unsigned octant = 0; octant < 8; ++octant) {
        unsigned place = 0;
        append(cuts, 4, octant, orders[octant], place);
    }
    return orders;
}

}  // namespace space
