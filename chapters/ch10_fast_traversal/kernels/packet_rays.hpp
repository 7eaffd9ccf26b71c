/// @file
/// Rays of a packet side by side, with all that their walk asks of them, and the ranges in which
/// all lie.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/many_types.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_lanes.hpp"
#include "chapters/ch10_fast_traversal/kernels/wide_kernel.hpp"

namespace space::SPACE_ISA {
namespace {

/// The t beyond which nothing matters to a ray whose nearest hit is at t; none is after infinity.
SPACE_INLINE float limit_after(float t) {
    return t < __builtin_inff() ? float_after(t) : t;
}
SPACE_INLINE void set_limit(PacketRays& rays, unsigned ray) {
    rays.limit[ray] = rays.is_any_asked ? -1.0f : limit_after(rays.t[ray]);
}

/// The least and the largest of some floats.
struct Range {
    float low, high;
};
SPACE_INLINE Range range_of(const float* numbers, unsigned count) {
    Float4 low = load<4>(numbers), high = low;
    for (unsigned first = 4; first < count; first += 4) {
        low = smaller(low, load<4>(numbers + first));
        high = larger(high, load<4>(numbers + first));
    }
    Range range{low[0], high[0]};
    for (int i = 1; i < 4; ++i) {
        range.low = low[i] < range.low ? low[i] : range.low;
        range.high = high[i] > range.high ? high[i] : range.high;
    }
    return range;
}

/// Rays as they come, eight floats each, side by side. Places behind the last hold it again.
SPACE_INLINE void lay_side_by_side(PacketRays& rays, unsigned places) {
    for (unsigned i = 0; i < places; ++i) {
        const float* const ray = rays.rays + 8 * (i < rays.count ? i : rays.count - 1);
        for (int axis = 0; axis < 3; ++axis) {
            rays.origin[axis][i] = ray[axis];
            rays.direction[axis][i] = ray[axis + 3];
        }
        rays.tmin[i] = ray[6] + 0.0f;  // not -0
        rays.tmax[i] = ray[7];
    }
}

// [fill_packet]
/// What prepare_kernel_ray asks of a ray, of all, along one axis: floats in range, and one sign.
SPACE_INLINE bool prepare_axis(PacketRays& rays, int axis, unsigned places, float largest) {
    constexpr float u = 0x1p-24f, shorter = 1.0f - 4.0f * u, longer = 1.0f + 6.0f * u;
    const RayFloats most = RayFloats{} + largest, least = RayFloats{} + 0x1p-90f;
    const bool backwards = rays.direction[axis][0] < 0.0f;
    const RayFloats sign = RayFloats{} + (backwards ? -1.0f : 1.0f);
    constexpr unsigned everyone = (1u << ray_lanes) - 1;
    unsigned fit = everyone;
    for (unsigned first = 0; first < places; first += ray_lanes) {
        const RayFloats o = rays_at(rays.origin[axis] + first),
                        d = rays_at(rays.direction[axis] + first), speed = d * sign;
        // What is not a number fails each comparison.
        fit &= at_most(-most, o) & at_most(o, most) & at_most(least, speed) & at_most(speed, most);
        const RayFloats inverse = 1.0f / d;
        *reinterpret_cast<RayFloats*>(rays.near_inverse[axis] + first) = inverse * shorter;
        *reinterpret_cast<RayFloats*>(rays.far_inverse[axis] + first) = inverse * longer;
    }
    const Range origin = range_of(rays.origin[axis], places),
                direction = range_of(rays.direction[axis], places);
    rays.direction_low[axis] = direction.low;
    rays.direction_high[axis] = direction.high;
    rays.near_origin[axis] = backwards ? origin.low : origin.high;
    rays.far_origin[axis] = backwards ? origin.high : origin.low;
    // 1 / d falls as d grows, and rounding keeps the order: these are the inverses' ranges.
    const float low = 1.0f / direction.high, high = 1.0f / direction.low;
    rays.near_low[axis] = low * shorter;
    rays.near_high[axis] = high * shorter;
    rays.far_low[axis] = low * longer;
    rays.far_high[axis] = high * longer;
    rays.near_row[axis] = unsigned(axis) + (backwards ? 3 : 0);
    rays.far_row[axis] = unsigned(axis) + (backwards ? 0 : 3);
    rays.has_one_origin = rays.has_one_origin && origin.low == origin.high;
    rays.longest += backwards ? -direction.low : direction.high;
    return fit == everyone;
}
// [fill_packet]

/// All that the walk asks. @return false where a ray is not for packets
SPACE_INLINE bool prepare_packet(PacketRays& rays, float largest) {
    const unsigned places = (rays.count + ray_lanes - 1) / ray_lanes * ray_lanes;
    lay_side_by_side(rays, places);
    rays.longest = 0.0f;
    rays.prepared_singles = 0;
    rays.has_one_origin = true;
    bool is_fit = true;
    for (int axis = 0; axis < 3; ++axis) is_fit &= prepare_axis(rays, axis, places, largest);
    rays.least_tmin = range_of(rays.tmin, places).low;
    for (unsigned i = 0; i < places; ++i) {
        is_fit &= rays.tmin[i] >= 0.0f && rays.tmin[i] <= rays.tmax[i];
        rays.limit[i] = i < rays.count ? limit_after(rays.tmax[i]) : -1.0f;
        rays.t[i] = __builtin_inff();
        rays.triangle[i] = no_kernel_hit;
    }
    return is_fit;
}

}  // namespace
}  // namespace space::SPACE_ISA
