/// @file
/// Four triangles at once in floats: which of them a ray surely misses, with a bound on all that is
/// rounded. The others are for the exact test.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/lanes.hpp"

namespace space::SPACE_ISA {
namespace {

/// What is undecided about four triangles, and what is sure.
struct LeafLanes {
    unsigned may_hit;   ///< bits of the lanes that are not surely missed
    unsigned must_hit;  ///< and of those that are surely hit, between tmin and the limit
};

SPACE_INLINE Float4 dot(const Float4* a, const Float4* b) {
    return fused(a[0], b[0], fused(a[1], b[1], a[2] * b[2]));
}
SPACE_INLINE void cross(const Float4* a, const Float4* b, Float4* result) {
    result[0] = fused_minus(a[1], b[2], a[2] * b[1]);
    result[1] = fused_minus(a[2], b[0], a[0] * b[2]);
    result[2] = fused_minus(a[0], b[1], a[1] * b[0]);
}
SPACE_INLINE Float4 one_norm(const Float4* a) {
    return size_of(a[0]) + size_of(a[1]) + size_of(a[2]);
}
/// x, with its sign changed where that of `sign` is minus.
SPACE_INLINE Float4 signed_by(Float4 x, Float4 sign) {
    return Float4(Int4(x) ^ (Int4(sign) & INT32_MIN));
}

// [leaf_filter]
/// Of four triangles, turned so that det is not negative, and above what these may be wrong by.
struct LeafVolumes {
    Float4 size, u, v, t;  ///< det, u det, v det and t det of the exact test, in floats
    Float4 bound;          ///< of u and v, and of size - (u + v), as signs are asked for
    Float4 late, early;    ///< of t against size times the limit, and against size times tmin
};

/// The volumes det, u, v and T = t det of chapter 2's filter, in floats: with u24 = 2^-24 in place
/// of 2^-53 its count of roundings is the same, except that the three edges are rounded here, which
/// it has counted, too. Each of det, u and v is off by at most gamma(7) times |d||e1||e2|,
/// |d||e2||s| and |d||e1||s|; a fused multiply-add only leaves roundings out. So, with the rounding
/// of u + v, `bound` = 10 u24 |d| (|e1||e2| + (|e1| + |e2|) |s|) is above the errors of u and det
/// together, of v and det, and of u + v and det; the tenth and the ninth unit are more than the
/// roundings of the norms and of the bound itself.
///
/// All are turned so that det is not negative. Where the exact det has the other sign, which takes
/// |det| <= its error, a hit has exact u, v, u + v between -|det| and 0 as they are turned here:
/// still within the bound. T is off by at most gamma(8) |e1||e2||s|, and t <= limit says T <= limit
/// det, where det is off by gamma(7) |d||e1||e2|: `late` = 10 u24 |e1||e2| (|s| + limit |d|). With
/// the other sign of det a T above all that is a t below 0. But a T below 0 would then be a t above
/// 0: so a triangle behind tmin is missed only where det is above the bound.
///
/// A hit's t, rounded, is between tmin and tmax: so t itself is between the float before tmin and
/// the one after tmax, the limit. (Next to tmin = 0 that is more than a rounding of t.)
///
/// Coordinates are below 2^31 here, and products below 2^100; one that underflows is off by 2^-149
/// times at most 2^33: that is the last term of the bounds, 2^-110.
SPACE_INLINE LeafVolumes volumes_of(const char* block, const KernelRay& ray, float limit) {
    Float4 e1[3], e2[3], s[3], d[3], p[3], q[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Float4 a = load<4>(block + 16 * axis);
        e1[axis] = load<4>(block + 16 * (axis + 3)) - a;
        e2[axis] = load<4>(block + 16 * (axis + 6)) - a;
        s[axis] = all<4>(ray.origin[axis]) - a;
        d[axis] = all<4>(ray.direction[axis]);
    }
    cross(d, e2, p);
    cross(s, e1, q);
    const Float4 det = dot(p, e1), tiny = all<4>(0x1p-110f);
    const Float4 n1 = one_norm(e1), n2 = one_norm(e2), n = one_norm(s), n12 = n1 * n2;
    const Float4 n12_10 = n12 * (10.0f * 0x1p-24f),
                 length_10 = all<4>(ray.direction_length * (10.0f * 0x1p-24f));
    return {.size = size_of(det),
            .u = signed_by(dot(p, s), det),
            .v = signed_by(dot(q, d), det),
            .t = signed_by(dot(q, e2), det),
            .bound = fused(fused(n1 + n2, n, n12), length_10, tiny),
            .late = fused(n12_10, n + all<4>(limit * ray.direction_length), tiny),
            .early = fused(n12_10, n + all<4>(ray.tmin * ray.direction_length), tiny)};
}

template <bool is_sure_asked>
SPACE_INLINE LeafLanes filter_leaf(const char* block, const KernelRay& ray, float limit) {
    const LeafVolumes of = volumes_of(block, ray, limit);
    const Float4 w = of.size - (of.u + of.v), inside = smaller(smaller(of.u, of.v), w);
    const Float4 after = of.t - fused(of.size, all<4>(limit), of.late),
                 before = fused(of.size, all<4>(ray.before), -of.t);
    // Where the limit is infinite and det is 0, `after` is not a number, and not above the bound.
    const unsigned missed = above(larger(after, -inside - of.bound), all<4>(0.0f)) |
                            (above(before, of.early) & above(of.size, of.bound));
    LeafLanes lanes{are_numbers(of.size) & ~missed, 0};  // an empty place has no numbers
    if (is_sure_asked) {
        const bool has_end = limit < __builtin_inff();
        lanes.must_hit = above(smaller(inside, of.size), of.bound) &
                         above(of.t - of.size * all<4>(ray.tmin), of.early) &
                         (has_end ? above(fused(of.size, all<4>(limit), -of.t), of.late) : 15u);
    }
    return lanes;
}
// [leaf_filter]

}  // namespace
}  // namespace space::SPACE_ISA
