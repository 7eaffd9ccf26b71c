/// @file
/// Sobol's low-discrepancy sequence in two dimensions, its matrices derived, and Owen's scrambling.
#pragma once

#include <cstdint>

namespace space {

/// A point of the unit square in 32-bit fractions: x = 2^31 means 1/2.
struct SobolPoint {
    std::uint32_t x, y;

    bool operator==(const SobolPoint&) const = default;
};

/// The direction numbers of the second dimension (Sobol' 1967), by their recurrence with the
/// primitive polynomial x + 1, whose degree is 1: v_0 = 1/2, v_k = v_(k-1) xor v_(k-1) / 2. The
/// k-th is what bit k of an index adds to y. In the first dimension bit k adds 2^-(k+1).
constexpr std::uint32_t direction_number(int k) {
    std::uint32_t v = 0x80000000u;
    for (int i = 0; i < k; ++i) v ^= v >> 1;
    return v;
}

/// The bits of each block of 2 step bits that are its upper half, for step = 1, 2, 4, 8, 16.
constexpr std::uint32_t upper_halves(int step) {
    return ~(0xFFFFFFFFu / ((1u << step) + 1));
}

/// Bit 0 becomes bit 31: the digits of an index become those of van der Corput's fraction.
constexpr std::uint32_t reversed_bits(std::uint32_t x) {
    for (int step = 16; step > 0; step /= 2)
        x = ((x & upper_halves(step)) >> step) | ((x << step) & upper_halves(step));
    return x;
}

// [sobol_point]
/// The point of this index. Every 2^m points that begin at a multiple of 2^m are a (0, m, 2)-net:
/// each of the 2^m equal boxes that halving the square's sides makes, in whatever order, holds
/// exactly one of them (Niederreiter 1992, section 4.1).
///
/// The recurrence of direction_number is Pascal's triangle modulo 2: digit j of v_k is C(k, j), odd
/// where the bits of j are among those of k (Lucas 1878). So digit j of y is the sum of the index's
/// bits over all k that contain j, and such sums take one step for each of the five bits of k.
constexpr SobolPoint sobol_point(std::uint32_t index) {
    const std::uint32_t x = reversed_bits(index);
    std::uint32_t y = x;
    for (int step = 1; step < 32; step *= 2) y ^= (y << step) & upper_halves(step);
    return {x, y};
}
// [sobol_point]

constexpr bool has_derived_matrices() {
    for (int k = 0; k < 32; ++k)
        if (sobol_point(1u << k) != SobolPoint{0x80000000u >> k, direction_number(k)}) return false;
    return true;
}
static_assert(has_derived_matrices());

// [owen]
/// A permutation of the fractions in which each digit is kept or flipped by a hash of the digits
/// above it: Owen's scrambling (1995). Numbers that share their first digits still share as many,
/// so a net stays a net; and each number alone is uniform over the seeds.
///
/// The hash (Laine & Karras 2011; these constants: Vegdahl 2021) works on the reversed bits, where
/// a sum, a product with an odd number and x xor x times an even number each let a bit depend only
/// on itself and on those below it.
constexpr std::uint32_t owen_scrambled_reversed(std::uint32_t reversed, std::uint32_t seed) {
    std::uint32_t x = reversed;
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}
constexpr std::uint32_t owen_scrambled(std::uint32_t fraction, std::uint32_t seed) {
    return reversed_bits(owen_scrambled_reversed(reversed_bits(fraction), seed));
}
// [owen]

}  // namespace space
