/// @file
/// Square roots by Newton's method from a bit-trick guess (Lichter23, section 2), one or four at a
/// time, and the hardware's own.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <experimental/simd>
#include <limits>
#include <span>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace space {

/// The constants of Lichter23: half the exponent's bias put back (2^29 - 2^22 in the bits), and a
/// correction that spreads the error of the first guess over both signs.
inline constexpr std::uint32_t root_guess_bias = (1u << 29) - (1u << 22) - 0x4C000u;

/// A first guess, at most 3.5 % off: halving the bits halves the exponent, and the mantissa nearly
/// so. Right for positive normal floats only.
// [root_guess]
inline float root_guess(float a) {
    return std::bit_cast<float>(root_guess_bias + (std::bit_cast<std::uint32_t>(a) >> 1));
}

/// Heron's step r = (r + a / r) / 2 squares the relative error: 3.5 % -> 6e-4 -> 2e-7 -> 2e-14.
template <int Rounds>
float newton_root(float a) {
    float r = root_guess(a);
    for (int round = 0; round < Rounds; ++round) r = 0.5f * (r + a / r);
    return r;
}
// [root_guess]

/// The cure for zero, denormals, infinity, NaN and negative numbers, with the answers of IEEE 754's
/// square root.
template <int Rounds>
float careful_newton_root(float a) {
    if (!(a > 0.0f)) return a == 0.0f ? a : std::numeric_limits<float>::quiet_NaN();
    if (a == std::numeric_limits<float>::infinity()) return a;
    if (a < std::numeric_limits<float>::min())
        return 0x1p-12f * newton_root<Rounds>(0x1p24f * a);  // now normal
    return newton_root<Rounds>(a);
}

/// Four independent roots in plain arrays: the compiler's vectoriser may do them at once.
template <int Rounds>
void newton_roots(std::span<const float, 4> a, std::span<float, 4> roots) {
    float r[4];
    for (int i = 0; i < 4; ++i) r[i] = root_guess(a[static_cast<std::size_t>(i)]);
    for (int round = 0; round < Rounds; ++round)
        for (int i = 0; i < 4; ++i) r[i] = 0.5f * (r[i] + a[static_cast<std::size_t>(i)] / r[i]);
    for (int i = 0; i < 4; ++i) roots[static_cast<std::size_t>(i)] = r[i];
}

/// GCC's vector types: the same operations written on four floats at once ("v4sf").
using Float4 = float __attribute__((vector_size(16)));
using Bits4 = std::uint32_t __attribute__((vector_size(16)));

template <int Rounds>
Float4 newton_root(Float4 a) {
    Float4 r = std::bit_cast<Float4>(root_guess_bias + (std::bit_cast<Bits4>(a) >> 1));
    for (int round = 0; round < Rounds; ++round) r = 0.5f * (r + a / r);
    return r;
}

/// The same with the library type that is on its way into the standard (P1928).
using Simd4 = std::experimental::fixed_size_simd<float, 4>;

template <int Rounds>
Simd4 newton_root(Simd4 a) {
    Simd4 r([&](auto i) { return root_guess(a[i]); });
    for (int round = 0; round < Rounds; ++round) r = 0.5f * (r + a / r);
    return r;
}

/// Newton for 1 / sqrt(a): y = y (3 - a y^2) / 2 needs no division; the guess mirrors root_guess
/// (Lomont 2003).
template <int Rounds>
float reciprocal_newton_root(float a) {
    float y = std::bit_cast<float>(0x5F375A86u - (std::bit_cast<std::uint32_t>(a) >> 1));
    for (int round = 0; round < Rounds; ++round) y *= 1.5f - 0.5f * a * y * y;
    return y;
}

#if defined(__SSE__)
/// The processor's estimate of 1 / sqrt(a), 12 bits of it, and Newton rounds on top. Processors of
/// different makers give different bits: bound its error, never compare it.
template <int Rounds>
float hardware_reciprocal_root(float a) {
    float y = _mm_cvtss_f32(_mm_rsqrt_ss(_mm_set_ss(a)));
    for (int round = 0; round < Rounds; ++round) y *= 1.5f - 0.5f * a * y * y;
    return y;
}
#endif

}  // namespace space
