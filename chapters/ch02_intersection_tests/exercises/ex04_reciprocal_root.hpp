/// @file
/// Exercise 2.4: Newton for the reciprocal root
/// Difficulty 2 of 3, about 20 minutes.
///
/// Newton's method for y = 1 / sqrt(a), a zero of f(y) = 1 / y^2 - a, needs no division: derive its
/// step, and take as many rounds as the error allows. The stub returns the first guess, up to 3.5 %
/// off. Wanted is a relative error of at most 2^-21 for every positive normal float; the exponent
/// tells how many rounds that takes.
#pragma once

#include "common/geometry.hpp"

#include <bit>
#include <cstdint>

namespace space {

inline float reciprocal_root(float a) {
    const float y = std::bit_cast<float>(0x5F375A86u - (std::bit_cast<std::uint32_t>(a) >> 1));
    // TODO: Newton's step for 1 / y^2 - a, and enough rounds of it
    return y;
}

}  // namespace space
