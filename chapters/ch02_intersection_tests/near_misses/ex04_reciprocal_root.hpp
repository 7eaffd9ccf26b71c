/// @file
/// Exercise 2.4, a near miss: two rounds leave 5e-6, ten times too much.
#pragma once

#include "common/geometry.hpp"

#include <bit>
#include <cstdint>

namespace space {

/// y, a guess at 1 / sqrt(a), made better.
template <class Real>
Real refined(Real a, Real y) {
    for (int round = 0; round < 2; ++round) y *= 1.5f - 0.5f * a * y * y;
    return y;
}

inline float reciprocal_root(float a) {
    return refined(a, std::bit_cast<float>(0x5F375A86u - (std::bit_cast<std::uint32_t>(a) >> 1)));
}

}  // namespace space
