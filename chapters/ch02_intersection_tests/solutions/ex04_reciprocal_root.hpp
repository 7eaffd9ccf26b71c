/// @file
/// Exercise 2.4, solution.
#pragma once

#include "common/geometry.hpp"

#include <bit>
#include <cstdint>

namespace space {

inline float reciprocal_root(float a) {
    float y = std::bit_cast<float>(0x5F375A86u - (std::bit_cast<std::uint32_t>(a) >> 1));
    for (int round = 0; round < 3; ++round) y *= 1.5f - 0.5f * a * y * y;  // y - f(y) / f'(y)
    return y;
}

}  // namespace space
