/// @file
/// A node with four or eight children: one row of floats for each side of their boxes, so that one
/// instruction tests a side of all of them.
#pragma once

#include "common/geometry.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace space {

/// Where a child is: a node, or the blocks of a leaf. One word, so that a ray's stack holds it
/// beside a distance.
struct WideChild {
    static constexpr std::uint32_t leaf_bit = 1u << 31;
    static constexpr unsigned count_shift = 28;
    static constexpr std::uint32_t max_blocks = 8;                        ///< of a leaf
    static constexpr std::uint32_t first_mask = (1u << count_shift) - 1;  ///< of all blocks

    std::uint32_t word = 0;

    static WideChild node(std::uint32_t index) { return {index}; }
    /// Of 1 to max_blocks blocks, one after the other.
    static WideChild leaf(std::uint32_t first, std::uint32_t count) {
        return {leaf_bit | (count - 1) << count_shift | first};
    }
    bool is_leaf() const { return (word & leaf_bit) != 0; }
    std::uint32_t index() const { return word; }  ///< of an inner node
    std::uint32_t first() const { return word & first_mask; }
    std::uint32_t count() const { return (word >> count_shift & (max_blocks - 1)) + 1; }
    bool operator==(const WideChild&) const = default;
};

// [wide_node]
/// Up to N children. What they have in common stands side by side: the lower planes across x of
/// all, then those across y and z, then the upper ones. The ray's direction alone tells which rows
/// hold the near planes. An empty place has a box that no ray meets: lower planes at infinity,
/// upper ones at minus infinity. Two cache lines for N = 4, four for N = 8.
template <int N>
struct alignas(64) WideNode {
    std::array<std::array<float, N>, 6> planes;
    std::array<WideChild, N> children;

    Aabb box(std::size_t i) const {
        return {{planes[0][i], planes[1][i], planes[2][i]},
                {planes[3][i], planes[4][i], planes[5][i]}};
    }
    void put(std::size_t i, const Aabb& box, WideChild child) {
        for (int axis = 0; axis < 3; ++axis) {
            planes[std::size_t(axis)][i] = box.min[axis];
            planes[std::size_t(axis) + 3][i] = box.max[axis];
        }
        children[i] = child;
    }
    bool is_used(std::size_t i) const { return planes[0][i] <= planes[3][i]; }
};
// [wide_node]
static_assert(sizeof(WideNode<4>) == 128 && sizeof(WideNode<8>) == 256);

}  // namespace space
