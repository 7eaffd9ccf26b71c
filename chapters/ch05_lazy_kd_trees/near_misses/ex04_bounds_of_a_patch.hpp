/// @file
/// Exercise 5.4, a near miss: the corners where they are, and where the highest bump brings them.
/// That bounds bumps from 0 on; where the lowest is a dent, or all are high, it is wrong.
#pragma once

#include "common/geometry.hpp"

#include <array>
#include <cstddef>

namespace space {

/// A triangle of a coarse mesh, the ways outwards at its corners, and between which heights its
/// bumps are.
struct CoarsePatch {
    std::array<Point3, 3> corners;
    std::array<Vector3, 3> outwards;  ///< of any length
    float lowest, highest;
};

inline Aabb bounds_of(const CoarsePatch& patch) {
    Double3 low(double{infinity}), high(-double{infinity}), size(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const Double3 corner(patch.corners[i]), way(patch.outwards[i]);
        for (const float height : {0.0f, patch.highest}) {
            const Double3 end = corner + double{height} * way;
            low = glm::min(low, end);
            high = glm::max(high, end);
            size = glm::max(size, glm::abs(corner) + glm::abs(double{height} * way));
        }
    }
    constexpr double margin = 8.0 * 0x1p-53;
    return {Point3(low - margin * size), Point3(high + margin * size)};
}

}  // namespace space
