/// @file
/// Numbers of rays side by side, as many as a register of this instruction set holds.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/lanes.hpp"

namespace space::SPACE_ISA {
namespace {

// As many floats, or half as many doubles, as a register of this instruction set holds.
#if defined SPACE_X86 && defined __AVX512F__
constexpr unsigned ray_lanes = 16;
#elif defined SPACE_X86 && defined __AVX2__
constexpr unsigned ray_lanes = 8;
#else
constexpr unsigned ray_lanes = 4;
#endif
constexpr unsigned half_lanes = ray_lanes / 2;
typedef float RayFloats __attribute__((vector_size(4 * ray_lanes), may_alias));
typedef float HalfFloats __attribute__((vector_size(4 * half_lanes), may_alias));
typedef double RayDoubles __attribute__((vector_size(4 * ray_lanes), may_alias));

#if defined SPACE_X86 && defined __AVX512F__
SPACE_INLINE RayFloats larger(RayFloats a, RayFloats b) {
    return _mm512_max_ps(a, b);
}
SPACE_INLINE RayFloats smaller(RayFloats a, RayFloats b) {
    return _mm512_min_ps(a, b);
}
SPACE_INLINE RayFloats fused(RayFloats a, RayFloats b, RayFloats c) {
    return _mm512_fmadd_ps(a, b, c);
}
SPACE_INLINE unsigned at_most(RayFloats a, RayFloats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
}
SPACE_INLINE unsigned above(RayDoubles a, RayDoubles b) {
    return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ);
}
SPACE_INLINE RayDoubles size_of(RayDoubles a) {
    return _mm512_abs_pd(a);
}
#elif !defined __AVX2__
SPACE_INLINE unsigned above(RayDoubles a, RayDoubles b) {
    return unsigned(a[0] > b[0]) | unsigned(a[1] > b[1]) << 1;
}
SPACE_INLINE RayDoubles size_of(RayDoubles a) {
    return a < 0.0 ? -a : a;
}
#endif
SPACE_INLINE double size_of(double a) {
    return __builtin_fabs(a);
}
#if defined SPACE_X86 && defined __AVX512F__
SPACE_INLINE void store_some(float* place, unsigned some, HalfFloats x) {
    _mm256_mask_storeu_ps(place, __mmask8(some), x);
}
#else
SPACE_INLINE void store_some(float* place, unsigned some, HalfFloats x) {
    for (unsigned i = 0; i < half_lanes; ++i)
        if ((some >> i & 1) != 0) place[i] = x[i];
}
#endif
#ifndef __AVX2__
SPACE_INLINE unsigned at_most(HalfFloats a, HalfFloats b) {
    return unsigned(a[0] <= b[0]) | unsigned(a[1] <= b[1]) << 1;
}
#endif
SPACE_INLINE HalfFloats half_at(const float* all) {
    return *reinterpret_cast<const HalfFloats*>(all);
}
SPACE_INLINE RayFloats rays_at(const float* all) {
    return *reinterpret_cast<const RayFloats*>(all);
}

}  // namespace
}  // namespace space::SPACE_ISA
