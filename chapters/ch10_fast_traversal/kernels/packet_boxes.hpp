/// @file
/// Boxes and a packet of rays: eight against all of its rays together, then one against each ray.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/many_types.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_lanes.hpp"

namespace space::SPACE_ISA {
namespace {

/// What nodes need of all rays together.
struct PacketSpan {
    Float8 near_origin[3], far_origin[3], near_low[3], near_high[3], far_low[3], far_high[3], tmin;
    size_t near_row[3], far_row[3];
};
SPACE_INLINE PacketSpan span_of(const PacketRays& rays) {
    PacketSpan span;
    for (int axis = 0; axis < 3; ++axis) {
        span.near_origin[axis] = all<8>(rays.near_origin[axis]);
        span.far_origin[axis] = all<8>(rays.far_origin[axis]);
        span.near_low[axis] = all<8>(rays.near_low[axis]);
        span.near_high[axis] = all<8>(rays.near_high[axis]);
        span.far_low[axis] = all<8>(rays.far_low[axis]);
        span.far_high[axis] = all<8>(rays.far_high[axis]);
        span.near_row[axis] = rays.near_row[axis] * 32;
        span.far_row[axis] = rays.far_row[axis] * 32;
    }
    span.tmin = all<8>(rays.least_tmin);
    return span;
}

// [packet_span]
/// Which of a node's eight children any ray of the packet may meet: interval arithmetic. A near
/// plane is met no sooner than with the origin that is nearest to it and the reciprocal that gives
/// least. Rounding keeps the order of numbers, so what is computed from the ends of the ranges is
/// no more than what chapter 2's slab test computes for each ray, and that is conservative.
SPACE_INLINE unsigned children_met_by_any(const char* node, const PacketSpan& rays, Float8 limit,
                                          Float8& enter) {
    Float8 near[3], far[3];
    for (int axis = 0; axis < 3; ++axis) {
        const Float8 first = load<8>(node + rays.near_row[axis]) - rays.near_origin[axis],
                     last = load<8>(node + rays.far_row[axis]) - rays.far_origin[axis];
        near[axis] = smaller(first * rays.near_low[axis], first * rays.near_high[axis]);
        far[axis] = larger(last * rays.far_low[axis], last * rays.far_high[axis]);
    }
    enter = larger(larger(near[0], near[1]), larger(near[2], rays.tmin));
    const Float8 leave = smaller(smaller(far[0], far[1]), far[2]) + 0x1p-140f;
    return at_most(enter, smaller(leave, limit));
}
// [packet_span]

// [packet_slab]
/// Which of these rays meet one child, whose planes all rays share: chapter 2's conservative test.
template <bool has_one_origin>
SPACE_INLINE uint64_t rays_that_meet(const char* node, unsigned child, const PacketRays& rays,
                                     const PacketSpan& span, uint64_t some) {
    uint64_t met = 0;
    for (unsigned first = 0; first < rays.count; first += ray_lanes) {
        if ((some >> first & ((UINT64_C(1) << ray_lanes) - 1)) == 0) continue;
        RayFloats near[3], far[3];
        for (int axis = 0; axis < 3; ++axis) {
            const float near_plane =
                            reinterpret_cast<const float*>(node + span.near_row[axis])[child],
                        far_plane =
                            reinterpret_cast<const float*>(node + span.far_row[axis])[child];
            const RayFloats shorter = rays_at(rays.near_inverse[axis] + first),
                            longer = rays_at(rays.far_inverse[axis] + first);
            if (has_one_origin) {
                near[axis] = (near_plane - rays.near_origin[axis]) * shorter;
                far[axis] = (far_plane - rays.near_origin[axis]) * longer;
            } else {
                const RayFloats origin = rays_at(rays.origin[axis] + first);
                near[axis] = (near_plane - origin) * shorter;
                far[axis] = (far_plane - origin) * longer;
            }
        }
        const RayFloats enter =
            larger(larger(near[0], near[1]), larger(near[2], rays_at(rays.tmin + first)));
        const RayFloats leave = smaller(smaller(far[0], far[1]), far[2]) + 0x1p-140f;
        met |= uint64_t(at_most(enter, smaller(leave, rays_at(rays.limit + first)))) << first;
    }
    return met & some;
}
// [packet_slab]

}  // namespace
}  // namespace space::SPACE_ISA
