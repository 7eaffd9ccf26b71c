/// @file
/// Exercise 10.3: The octant's order
/// Difficulty 2 of 3, about 40 minutes.
///
/// A node with four children came from up to three cuts of the binary tree. Each cut put some
/// children on the lower side of an axis and the others on the upper side. For a ray that goes up
/// this axis the lower side is the near one, for a ray that goes down the upper. So the order in
/// which a ray should come to the children depends on the signs of its direction alone: there are
/// eight **octants**, and a node can hold an order for each, made once. Then no ray sorts anything
/// (WiVe, Fuetterling, Lojewski, Pfreundt, Hamann & Ebert 2017).
///
/// At each cut all children of the near side come before all of the far side. An order is one byte:
/// the first child's number in its lowest two bits, the next one's in the two above, and so on;
/// bits of places that no child fills are 0.
///
/// An octant's number has bit 0 set if the ray goes down the *x* axis, bit 1 for *y*, bit 2 for
/// *z*. A ray goes down where the sign bit of its direction is set, also that of a negative zero:
/// the slab test, which divides by it, sees it that way, too.
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
    // TODO: one bit for each axis
    static_cast<void>(direction);
    return 0;
}

/// The order for each octant. cuts[0] is the topmost; there are one to three.
inline std::array<std::uint8_t, 8> visit_orders(std::span<const Cut> cuts) {
    // TODO: this is 0, 1, 2, 3, for whatever ray
    static_cast<void>(cuts);
    std::array<std::uint8_t, 8> orders;
    orders.fill(0b11'10'01'00);
    return orders;
}

}  // namespace space
