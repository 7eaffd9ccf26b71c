/// @file
/// Exercise 2.4, solution.
#pragma once

#include "common/geometry.hpp"

#include <bit>
#include <cstdint>

namespace space {

/// y, a guess at 1 / sqrt(a), made better.
template <class Real>
Real refined(Real a, Real y) {
    for (int round = 0; round < 3; ++round) y *= 1.5f - 0.5f * a * y * y;  // y - f(y) / f'(y)
    return y;
}

inline float reciprocal_root(float a) {
    return refined(a, std::bit_cast<float>(0x5F375A86u - (std::bit_cast<std::uint32_t>(a) >> 1)));
}

}  // namespace space
