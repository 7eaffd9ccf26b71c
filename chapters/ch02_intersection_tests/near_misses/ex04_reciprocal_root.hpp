/// @file
/// Exercise 2.4, a near miss: two rounds leave 5e-6, ten times too much.
#pragma once

#include "common/geometry.hpp"

#include <bit>
#include <cstdint>

namespace space {

inline float reciprocal_root(float a) {
    float y = std::bit_cast<float>(0x5F375A86u - (std::bit_cast<std::uint32_t>(a) >> 1));
    for (int round = 0; round < 2; ++round) y *= 1.5f - 0.5f * a * y * y;
    return y;
}

}  // namespace space
