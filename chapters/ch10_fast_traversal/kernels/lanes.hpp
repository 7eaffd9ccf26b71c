/// @file
/// Four or eight floats at once, in the namespace of the instruction set that the including file is
/// compiled for. All that kernels ask of a processor stands here; the rest is their own text.
///
/// The including file defines SPACE_ISA, the namespace; without SPACE_X86 it gets the compiler's
/// own vectors, which every processor has. No function here is ever called by another file: each is
/// inlined or belongs to its file alone.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/kernel_types.hpp"

#ifdef SPACE_X86
#include <immintrin.h>
#endif

#define SPACE_INLINE [[gnu::always_inline]] inline

namespace space::SPACE_ISA {
namespace {

typedef float Float4 __attribute__((vector_size(16), may_alias));
typedef float Float8 __attribute__((vector_size(32), may_alias));
typedef double Double4 __attribute__((vector_size(32), may_alias));
typedef int64_t Long4 __attribute__((vector_size(32), may_alias));
typedef int32_t Int4 __attribute__((vector_size(16), may_alias));
typedef int32_t Int8 __attribute__((vector_size(32), may_alias));

/// The types of N lanes.
template <int N>
struct LanesOf;
template <>
struct LanesOf<4> {
    using Float = Float4;
    using Int = Int4;
};
template <>
struct LanesOf<8> {
    using Float = Float8;
    using Int = Int8;
};
template <int N>
using Floats = typename LanesOf<N>::Float;
template <int N>
using Ints = typename LanesOf<N>::Int;

template <int N>
SPACE_INLINE Floats<N> all(float x);
template <>
SPACE_INLINE Float4 all<4>(float x) {
    return Float4{x, x, x, x};
}
template <>
SPACE_INLINE Float8 all<8>(float x) {
    return Float8{x, x, x, x, x, x, x, x};
}
/// From an address that is a multiple of their size.
template <int N>
SPACE_INLINE Floats<N> load(const void* place) {
    return *static_cast<const Floats<N>*>(place);
}

/// From and to any address.
SPACE_INLINE Float4 load_any(const float* place) {
    Float4 result;
    __builtin_memcpy(&result, place, sizeof result);
    return result;
}
SPACE_INLINE void store(float* place, Float4 a) {
    __builtin_memcpy(place, &a, sizeof a);
}
SPACE_INLINE Double4 to_double(Float4 a) {
    return __builtin_convertvector(a, Double4);
}
SPACE_INLINE Float4 to_float(Double4 a) {
    return __builtin_convertvector(a, Float4);
}
SPACE_INLINE Double4 size_of(Double4 a) {
    return Double4(Long4(a) & INT64_MAX);
}

#ifdef SPACE_X86

SPACE_INLINE Float4 larger(Float4 a, Float4 b) {
    return _mm_max_ps(a, b);
}
SPACE_INLINE Float4 smaller(Float4 a, Float4 b) {
    return _mm_min_ps(a, b);
}
SPACE_INLINE Float4 size_of(Float4 a) {
    return _mm_andnot_ps(_mm_set1_ps(-0.0f), a);
}
#ifdef __AVX512VL__
SPACE_INLINE unsigned at_most(Float4 a, Float4 b) {
    return _mm_cmp_ps_mask(a, b, _CMP_LE_OQ);
}
SPACE_INLINE unsigned above(Float4 a, Float4 b) {
    return _mm_cmp_ps_mask(a, b, _CMP_GT_OQ);
}
SPACE_INLINE unsigned are_numbers(Float4 a) {
    return _mm_cmp_ps_mask(a, a, _CMP_ORD_Q);
}
SPACE_INLINE unsigned at_most(Float8 a, Float8 b) {
    return _mm256_cmp_ps_mask(a, b, _CMP_LE_OQ);
}
#else
SPACE_INLINE unsigned at_most(Float4 a, Float4 b) {
    return unsigned(_mm_movemask_ps(_mm_cmple_ps(a, b)));
}
SPACE_INLINE unsigned above(Float4 a, Float4 b) {
    return unsigned(_mm_movemask_ps(_mm_cmpgt_ps(a, b)));
}
SPACE_INLINE unsigned are_numbers(Float4 a) {
    return unsigned(_mm_movemask_ps(_mm_cmpord_ps(a, a)));
}
#endif
#ifdef __AVX2__
SPACE_INLINE Double4 larger(Double4 a, Double4 b) {
    return _mm256_max_pd(a, b);
}
#ifdef __AVX512VL__
SPACE_INLINE unsigned above(Double4 a, Double4 b) {
    return _mm256_cmp_pd_mask(a, b, _CMP_GT_OQ);
}
#else
SPACE_INLINE unsigned above(Double4 a, Double4 b) {
    return unsigned(_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_GT_OQ)));
}
#endif
SPACE_INLINE Float8 larger(Float8 a, Float8 b) {
    return _mm256_max_ps(a, b);
}
SPACE_INLINE Float8 smaller(Float8 a, Float8 b) {
    return _mm256_min_ps(a, b);
}
#ifndef __AVX512VL__
SPACE_INLINE unsigned at_most(Float8 a, Float8 b) {
    return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)));
}
#endif
#else
typedef double Double2 __attribute__((vector_size(16), may_alias));
SPACE_INLINE Double4 larger(Double4 a, Double4 b) {
    const Double2 low = _mm_max_pd(__builtin_shufflevector(a, a, 0, 1),
                                   __builtin_shufflevector(b, b, 0, 1)),
                  high = _mm_max_pd(__builtin_shufflevector(a, a, 2, 3),
                                    __builtin_shufflevector(b, b, 2, 3));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3);
}
SPACE_INLINE unsigned above(Double4 a, Double4 b) {
    const Double2 low = _mm_cmpgt_pd(__builtin_shufflevector(a, a, 0, 1),
                                     __builtin_shufflevector(b, b, 0, 1)),
                  high = _mm_cmpgt_pd(__builtin_shufflevector(a, a, 2, 3),
                                      __builtin_shufflevector(b, b, 2, 3));
    return unsigned(_mm_movemask_pd(low)) | unsigned(_mm_movemask_pd(high)) << 2;
}
/// The halves of eight.
struct Halves {
    Float4 low, high;
};
SPACE_INLINE Halves halves(Float8 a) {
    return {__builtin_shufflevector(a, a, 0, 1, 2, 3), __builtin_shufflevector(a, a, 4, 5, 6, 7)};
}
SPACE_INLINE Float8 joined(Float4 low, Float4 high) {
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
SPACE_INLINE Float8 larger(Float8 a, Float8 b) {
    const Halves x = halves(a), y = halves(b);
    return joined(larger(x.low, y.low), larger(x.high, y.high));
}
SPACE_INLINE Float8 smaller(Float8 a, Float8 b) {
    const Halves x = halves(a), y = halves(b);
    return joined(smaller(x.low, y.low), smaller(x.high, y.high));
}
SPACE_INLINE unsigned at_most(Float8 a, Float8 b) {
    const Halves x = halves(a), y = halves(b);
    return at_most(x.low, y.low) | at_most(x.high, y.high) << 4;
}
#endif
#ifdef __FMA__
SPACE_INLINE Float4 fused(Float4 a, Float4 b, Float4 c) {
    return _mm_fmadd_ps(a, b, c);
}
SPACE_INLINE Float8 fused(Float8 a, Float8 b, Float8 c) {
    return _mm256_fmadd_ps(a, b, c);
}
SPACE_INLINE Float4 fused_minus(Float4 a, Float4 b, Float4 c) {
    return _mm_fmsub_ps(a, b, c);
}
#else
SPACE_INLINE Float4 fused(Float4 a, Float4 b, Float4 c) {
    return a * b + c;
}
SPACE_INLINE Float8 fused(Float8 a, Float8 b, Float8 c) {
    return a * b + c;
}
SPACE_INLINE Float4 fused_minus(Float4 a, Float4 b, Float4 c) {
    return a * b - c;
}
#endif

/// Bits of the lanes that hold numbers from 0 on.
SPACE_INLINE unsigned not_below_zero(Float4 a) {
    return at_most(all<4>(0.0f), a);
}

/// Bits of the lanes with the sign minus.
SPACE_INLINE unsigned below_zero(Float4 a) {
    return unsigned(_mm_movemask_ps(a));
}

#else  // any processor

template <class Lanes>
SPACE_INLINE Lanes larger(Lanes a, Lanes b) {
    return a > b ? a : b;
}
template <class Lanes>
SPACE_INLINE Lanes smaller(Lanes a, Lanes b) {
    return a < b ? a : b;
}
SPACE_INLINE Float4 size_of(Float4 a) {
    return a < 0.0f ? -a : a;
}
template <class Lanes>
SPACE_INLINE Lanes fused(Lanes a, Lanes b, Lanes c) {
    return a * b + c;
}
SPACE_INLINE Float4 fused_minus(Float4 a, Float4 b, Float4 c) {
    return a * b - c;
}
SPACE_INLINE unsigned at_most(Float4 a, Float4 b);
SPACE_INLINE unsigned not_below_zero(Float4 a) {
    return at_most(all<4>(0.0f), a);
}
template <int N, class Lanes>
SPACE_INLINE unsigned bits_of_lanes(Lanes truths) {
    unsigned bits = 0;
    for (int i = 0; i < N; ++i) bits |= (unsigned(truths[i]) & 1u) << i;
    return bits;
}
SPACE_INLINE unsigned below_zero(Float4 a) {
    return bits_of_lanes<4>(a < 0.0f);
}
SPACE_INLINE unsigned at_most(Float4 a, Float4 b) {
    return bits_of_lanes<4>(a <= b);
}
SPACE_INLINE unsigned at_most(Float8 a, Float8 b) {
    return bits_of_lanes<8>(a <= b);
}
SPACE_INLINE unsigned above(Float4 a, Float4 b) {
    return bits_of_lanes<4>(a > b);
}
SPACE_INLINE unsigned above(Double4 a, Double4 b) {
    return bits_of_lanes<4>(a > b);
}
SPACE_INLINE unsigned are_numbers(Float4 a) {
    return bits_of_lanes<4>(a == a);
}

#endif

}  // namespace
}  // namespace space::SPACE_ISA
