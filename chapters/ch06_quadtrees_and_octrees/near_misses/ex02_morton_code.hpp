/// @file
/// Exercise 6.2, a near miss: 1 is to have the last place, so coordinates are multiplied by that
/// place, 2^21 - 1. All other planes move up with it: 0.5 is in the lower half, and the code is not
/// that of the cell.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace space {

/// The point is in the closed cube from 0 to 1.
inline std::uint64_t morton_code_of(const Point3& point) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto place = static_cast<std::uint64_t>(point[axis] * (0x1p21f - 1.0f));
        for (int i = 0; i < 21; ++i) code |= (place >> i & 1u) << (3 * i + axis);
    }
    return code;
}

/// Three bits are a digit, and the highest of the 64 bits is not used.
inline int common_depth(std::uint64_t a, std::uint64_t b) {
    return (std::countl_zero(a ^ b) - 1) / 3;
}

}  // namespace space
