/// @file
/// Chapter 2's filter for four triangles at once: the same operations on doubles in the same order,
/// so that t, u and v have the same bits. What it can't decide is for FilteredExact itself.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/lanes.hpp"

namespace space::SPACE_ISA {
namespace {

/// What is decided about four triangles.
struct ExactLanes {
    unsigned hit;        ///< lanes that are hit, between tmin and tmax
    unsigned undecided;  ///< lanes for FilteredExact
    Float4 t, u, v;      ///< of those that are hit
};

/// How far x lies outside of the interval between 0 and `end`.
SPACE_INLINE Double4 outside(Double4 x, Double4 end) {
    const Double4 half = 0.5 * end;
    return size_of(x - half) - size_of(half);
}
SPACE_INLINE Double4 dot(const Double4* a, const Double4* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
SPACE_INLINE void cross(const Double4* a, const Double4* b, Double4* result) {
    result[0] = a[1] * b[2] - b[1] * a[2];
    result[1] = a[2] * b[0] - b[2] * a[0];
    result[2] = a[0] * b[1] - b[0] * a[1];
}
SPACE_INLINE Double4 one_norm(const Double4* a) {
    return size_of(a[0]) + size_of(a[1]) + size_of(a[2]);
}

// [exact_lanes]
/// Beyond FilteredExact it decides two cases: where the whole interval of t, rounded, is before
/// tmin or after tmax, the nearest float is, too. Rays that leave a surface meet their own triangle
/// so.
SPACE_INLINE ExactLanes exact_lanes(const char* block, const KernelRay& ray) {
    Double4 e1[3], e2[3], s[3], d[3], p[3], q[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Double4 a = to_double(load<4>(block + 16 * axis));
        e1[axis] = to_double(load<4>(block + 16 * (axis + 3))) - a;
        e2[axis] = to_double(load<4>(block + 16 * (axis + 6))) - a;
        s[axis] = double(ray.origin[axis]) - a;
        d[axis] = Double4{} + double(ray.direction[axis]);
    }
    const Double4 nd = one_norm(d), n1 = one_norm(e1), n2 = one_norm(e2), ns = one_norm(s);
    const Double4 bound = 10.0 * 0x1p-53 * nd * (n1 * n2 + (n1 + n2) * ns);
    cross(d, e2, p);
    const Double4 det = dot(p, e1), u = dot(p, s), u_outside = outside(u, det);
    cross(s, e1, q);
    const Double4 v = dot(q, d), v_outside = outside(v, det - u);
    const unsigned missed = above(larger(u_outside, v_outside), bound),
                   inside = above(-bound, larger(u_outside, v_outside));
    const Double4 inverse = 1.0 / det, t = dot(q, e2) * inverse;
    const Double4 slack = 14.0 * 0x1p-53 * n1 * n2 * (ns + size_of(t) * nd) * size_of(inverse);
    const Float4 low = to_float(t - slack), high = to_float(t + slack);
    const Float4 tmin = all<4>(ray.tmin), tmax = all<4>(ray.tmax);
    const unsigned one_float = at_most(low, high) & at_most(high, low),
                   beyond = above(tmin, high) | above(low, tmax);
    return {.hit = inside & one_float & ~beyond,
            .undecided = ~missed & ~(inside & (one_float | beyond)),
            .t = low,
            .u = to_float(u * inverse),
            .v = to_float(v * inverse)};
}
// [exact_lanes]

}  // namespace
}  // namespace space::SPACE_ISA
