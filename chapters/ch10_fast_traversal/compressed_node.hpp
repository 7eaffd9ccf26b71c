/// @file
/// A node of eight children in 96 bytes: their planes are whole numbers from 0 to 255, in steps of
/// a power of two from the node's lower corner (Ylitie, Karras & Laine 2017, section 3.2).
#pragma once

#include "chapters/ch10_fast_traversal/wide_node.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace space {

// [compressed_node]
/// Rows of bytes in the order of WideNode's rows of floats. Used places come first.
struct alignas(32) CompressedNode {
    std::array<float, 3> origin;            ///< not above any child's lower corner
    std::array<std::uint8_t, 3> exponents;  ///< the step is 2^(exponent - 127)
    std::uint8_t count;                     ///< of the children
    std::array<std::array<std::uint8_t, 8>, 6> planes;
    std::array<WideChild, 8> children;

    float step(std::size_t axis) const {
        return std::bit_cast<float>(std::uint32_t{exponents[axis]} << 23);
    }
    /// Where plane number q lies. The product is exact, a byte times a power of two; so the sum is
    /// rounded once, as a fused multiply-add rounds it: every processor finds the same plane.
    float plane(std::size_t axis, int q) const {
        return origin[axis] + static_cast<float>(q) * step(axis);
    }
    Aabb box(std::size_t i) const {
        Aabb box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.min[int(axis)] = plane(axis, planes[axis][i]);
            box.max[int(axis)] = plane(axis, planes[axis + 3][i]);
        }
        return box;
    }
    bool is_used(std::size_t i) const { return i < count; }
};
// [compressed_node]
static_assert(sizeof(CompressedNode) == 96);

// [outward]
/// The largest plane that is not above x, which is not below the origin; the smallest that is not
/// below x, which is not above plane 255. Planes do not fall as q grows, since rounding keeps
/// order. So the first guess, by a quotient that is rounded, is put right by looking at the planes
/// themselves, as rays will see them: no box is smaller than it was, whatever was rounded.
inline int plane_below(const CompressedNode& node, std::size_t axis, float x) {
    const double steps = (double{x} - double{node.origin[axis]}) / double{node.step(axis)};
    int q = static_cast<int>(std::clamp(std::floor(steps), 0.0, 255.0));
    while (q > 0 && !(node.plane(axis, q) <= x)) --q;  // plane 0 is the origin
    return q;
}
inline int plane_above(const CompressedNode& node, std::size_t axis, float x) {
    const double steps = (double{x} - double{node.origin[axis]}) / double{node.step(axis)};
    int q = static_cast<int>(std::clamp(std::ceil(steps), 0.0, 255.0));
    while (q < 255 && !(node.plane(axis, q) >= x)) ++q;
    return q;
}

/// Takes the smallest step with which plane 255 is not below x.
inline void take_step(CompressedNode& node, std::size_t axis, float x) {
    const double step = (double{x} - double{node.origin[axis]}) / 255.0;
    int exponent = std::clamp(step > 0.0 ? std::ilogb(step) + 127 : 1, 1, 254);
    node.exponents[axis] = static_cast<std::uint8_t>(exponent);
    while (exponent < 254 && !(node.plane(axis, 255) >= x))
        node.exponents[axis] = static_cast<std::uint8_t>(++exponent);
}
// [outward]

/// Each child's box in the new node holds what it was in the old one. (`children` are taken as they
/// are: who compresses a tree puts in where they stand now.)
inline CompressedNode compressed(const WideNode<8>& node) {
    CompressedNode small{};
    Aabb all;
    std::array<std::size_t, 8> used{};
    for (std::size_t i = 0; i < 8; ++i) {
        if (!node.is_used(i)) continue;
        all.extend(node.box(i));
        used[small.count++] = i;
    }
    for (std::size_t axis = 0; axis < 3 && small.count > 0; ++axis) {
        small.origin[axis] = all.min[int(axis)];
        take_step(small, axis, all.max[int(axis)]);
        for (std::size_t i = 0; i < small.count; ++i) {
            const Aabb box = node.box(used[i]);
            small.planes[axis][i] =
                static_cast<std::uint8_t>(plane_below(small, axis, box.min[int(axis)]));
            small.planes[axis + 3][i] =
                static_cast<std::uint8_t>(plane_above(small, axis, box.max[int(axis)]));
        }
    }
    for (std::size_t i = 0; i < small.count; ++i) small.children[i] = node.children[used[i]];
    return small;
}

}  // namespace space
