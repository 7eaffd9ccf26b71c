/// @file
/// Triangles of a leaf, four side by side.
#pragma once

#include "common/geometry.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace space {

// [triangle_block]
/// Up to four triangles by component: the x of all first corners, their y, their z, then the second
/// and the third corners; and which triangles they are. Corners, not edges: an edge that is rounded
/// to floats has lost its triangle. Empty places come last and hold no numbers.
struct alignas(32) TriangleBlock {
    static constexpr std::size_t size = 4;
    static constexpr std::uint32_t nobody = ~0u;

    std::array<std::array<float, size>, 9> corners;
    std::array<std::uint32_t, size> indices;

    void put(std::size_t lane, const Triangle& triangle, std::uint32_t index) {
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis)
                corners[std::size_t(3 * corner + axis)][lane] = triangle[corner][axis];
        indices[lane] = index;
    }
    void clear(std::size_t lane) {
        for (auto& row : corners) row[lane] = std::numeric_limits<float>::quiet_NaN();
        indices[lane] = nobody;
    }
    Triangle triangle(std::size_t lane) const {
        const auto corner = [&](std::size_t c) {
            return Point3(corners[3 * c][lane], corners[3 * c + 1][lane], corners[3 * c + 2][lane]);
        };
        return {corner(0), corner(1), corner(2)};
    }
    bool is_used(std::size_t lane) const { return indices[lane] != nobody; }
};
// [triangle_block]
static_assert(sizeof(TriangleBlock) == 160);

}  // namespace space
