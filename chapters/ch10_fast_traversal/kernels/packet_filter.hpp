/// @file
/// Chapter 2's filter for one triangle and several rays, with the same bits.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/packet_lanes.hpp"

namespace space::SPACE_ISA {
namespace {

/// A triangle as chapter 2's filter sees it.
struct PacketTriangle {
    double a[3], e1[3], e2[3], size1, size2;
    uint32_t index;
};
template <class Number>
SPACE_INLINE Number size_of_three(const Number* v) {
    return size_of(v[0]) + size_of(v[1]) + size_of(v[2]);
}
SPACE_INLINE PacketTriangle packet_triangle(const float* block, unsigned lane) {
    PacketTriangle triangle;
    for (unsigned axis = 0; axis < 3; ++axis) {
        triangle.a[axis] = double(block[4 * axis + lane]);
        triangle.e1[axis] = double(block[4 * (axis + 3) + lane]) - triangle.a[axis];
        triangle.e2[axis] = double(block[4 * (axis + 6) + lane]) - triangle.a[axis];
    }
    triangle.size1 = size_of_three(triangle.e1);
    triangle.size2 = size_of_three(triangle.e2);
    triangle.index = reinterpret_cast<const uint32_t*>(block)[36 + lane];
    return triangle;
}

// [packet_origin]
/// What hangs on the origin, and not on the direction: once for all rays where they have one origin
/// (Number is double), else for each (RayDoubles).
template <class Number>
struct PacketOrigin {
    Number s[3], q[3], size, volume, bound;
};
template <class Number>
SPACE_INLINE PacketOrigin<Number> packet_origin(const PacketTriangle& triangle,
                                                const Number (&origin)[3]) {
    const double(&e1)[3] = triangle.e1, (&e2)[3] = triangle.e2;
    PacketOrigin<Number> o;
    for (int axis = 0; axis < 3; ++axis) o.s[axis] = origin[axis] - triangle.a[axis];
    const Number(&s)[3] = o.s;
    o.q[0] = s[1] * e1[2] - e1[1] * s[2];
    o.q[1] = s[2] * e1[0] - e1[2] * s[0];
    o.q[2] = s[0] * e1[1] - e1[0] * s[1];
    o.size = size_of_three(o.s);
    o.volume = o.q[0] * e2[0] + o.q[1] * e2[1] + o.q[2] * e2[2];
    o.bound = triangle.size1 * triangle.size2 + (triangle.size1 + triangle.size2) * o.size;
    return o;
}
// [packet_origin]

/// How far x lies outside of the interval between 0 and `end`.
SPACE_INLINE RayDoubles outside_of(RayDoubles x, RayDoubles end) {
    const RayDoubles half = end * 0.5;
    return size_of(x - half) - size_of(half);
}

/// What chapter 2's filter says of some rays and one triangle.
struct PacketVerdict {
    unsigned hit, undecided;  ///< bits of the rays; others miss
    HalfFloats t, u, v;
};

// [packet_filter]
/// Operation by operation FilteredExact::intersect, so each bit is the same.
template <class Number>
SPACE_INLINE PacketVerdict packet_filter(const PacketTriangle& triangle,
                                         const PacketOrigin<Number>& o, const RayDoubles (&d)[3],
                                         RayDoubles length, unsigned some) {
    const double(&e1)[3] = triangle.e1, (&e2)[3] = triangle.e2;
    const RayDoubles bound = 10.0 * 0x1p-53 * length * o.bound;
    const RayDoubles p[3] = {d[1] * e2[2] - e2[1] * d[2], d[2] * e2[0] - e2[2] * d[0],
                             d[0] * e2[1] - e2[0] * d[1]};
    const RayDoubles det = p[0] * e1[0] + p[1] * e1[1] + p[2] * e1[2],
                     u = p[0] * o.s[0] + p[1] * o.s[1] + p[2] * o.s[2],
                     u_outside = outside_of(u, det);
    const RayDoubles v = o.q[0] * d[0] + o.q[1] * d[1] + o.q[2] * d[2],
                     v_outside = outside_of(v, det - u);
    PacketVerdict verdict;
    verdict.hit = 0;
    verdict.undecided = some & ~(above(u_outside, bound) | above(v_outside, bound));
    if (verdict.undecided == 0) return verdict;
    const unsigned inside = above(-bound, u_outside) & above(-bound, v_outside);
    const RayDoubles inverse = 1.0 / det, t = o.volume * inverse;
    const RayDoubles slack = 14.0 * 0x1p-53 * triangle.size1 * triangle.size2 *
                             (o.size + size_of(t) * length) * size_of(inverse);
    verdict.t = __builtin_convertvector(t - slack, HalfFloats);
    verdict.u = __builtin_convertvector(u * inverse, HalfFloats);
    verdict.v = __builtin_convertvector(v * inverse, HalfFloats);
    const HalfFloats latest = __builtin_convertvector(t + slack, HalfFloats);
    const unsigned common = at_most(verdict.t, latest) & at_most(latest, verdict.t);
    verdict.hit = verdict.undecided & inside & common;
    verdict.undecided &= ~verdict.hit;
    return verdict;
}
// [packet_filter]

}  // namespace
}  // namespace space::SPACE_ISA
