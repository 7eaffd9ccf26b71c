/// @file
/// A leaf's triangles, each against those rays of a packet that come to it.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/many_types.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_filter.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_lanes.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_rays.hpp"
#include "chapters/ch10_fast_traversal/kernels/wide_kernel.hpp"

namespace space::SPACE_ISA {
namespace {

/// Hits that the filter is sure of, in the order of chapter 1's `nearer`. @return whether one
/// counts
SPACE_INLINE bool take_hits(PacketRays& rays, unsigned first, const PacketVerdict& verdict,
                            uint32_t index) {
    const HalfFloats t = verdict.t, before = half_at(rays.t + first);
    const unsigned in_time = verdict.hit & at_most(half_at(rays.tmin + first), t) &
                             at_most(t, half_at(rays.tmax + first)) & at_most(t, before);
    if (in_time == 0) return false;
    unsigned nearer = in_time;
    for (unsigned equal = in_time & at_most(before, t); equal != 0; equal &= equal - 1) {
        const unsigned i = unsigned(__builtin_ctz(equal));
        if (rays.triangle[first + i] <= index) nearer &= ~(1u << i);
    }
    store_some(rays.t + first, nearer, t);
    store_some(rays.u + first, nearer, verdict.u);
    store_some(rays.v + first, nearer, verdict.v);
    for (unsigned left = nearer; left != 0; left &= left - 1) {
        const unsigned ray = first + unsigned(__builtin_ctz(left));
        rays.triangle[ray] = index;
        set_limit(rays, ray);
    }
    return nearer != 0;
}

/// Rays that the filter leaves to the exact stages.
[[gnu::noinline]] bool ask_exactly(const float* block, unsigned lane, PacketRays& rays,
                                   unsigned first, unsigned some, ExactPacketLane exact) {
    bool is_changed = false;
    for (; some != 0; some &= some - 1) {
        const unsigned ray = first + unsigned(__builtin_ctz(some));
        const uint32_t before = rays.triangle[ray];
        exact(rays, ray, block, lane);
        if (rays.triangle[ray] == before) continue;
        set_limit(rays, ray);
        is_changed = true;
    }
    return is_changed;
}

/// One triangle against all these rays, half a register's at a time. @return whether any ray's
/// limit has changed
template <bool has_one_origin>
SPACE_INLINE bool test_triangle(const float* block, unsigned lane, PacketRays& rays, uint64_t some,
                                ExactPacketLane exact) {
    const PacketTriangle triangle = packet_triangle(block, lane);
    PacketOrigin<double> shared;
    if (has_one_origin)
        shared = packet_origin<double>(
            triangle,
            {double(rays.origin[0][0]), double(rays.origin[1][0]), double(rays.origin[2][0])});
    bool is_changed = false;
    for (unsigned first = 0; first < rays.count; first += half_lanes) {
        const unsigned here = unsigned(some >> first) & ((1u << half_lanes) - 1);
        if (here == 0) continue;
        RayDoubles d[3];
        for (int axis = 0; axis < 3; ++axis)
            d[axis] = __builtin_convertvector(half_at(rays.direction[axis] + first), RayDoubles);
        const RayDoubles length = size_of_three(d);
        PacketVerdict verdict;
        if (has_one_origin) {
            verdict = packet_filter(triangle, shared, d, length, here);
        } else {
            RayDoubles origin[3];
            for (int axis = 0; axis < 3; ++axis)
                origin[axis] =
                    __builtin_convertvector(half_at(rays.origin[axis] + first), RayDoubles);
            verdict = packet_filter(triangle, packet_origin<RayDoubles>(triangle, origin), d,
                                    length, here);
        }
        if (verdict.hit != 0) is_changed |= take_hits(rays, first, verdict, triangle.index);
        if (verdict.undecided != 0)
            is_changed |= ask_exactly(block, lane, rays, first, verdict.undecided, exact);
    }
    return is_changed;
}

// [packet_cull]
/// Which of a block's triangles any ray of the packet may hit, by its origin, which all share, and
/// the range of the directions. The volumes u, v and w = det - u - v are linear in the direction:
/// d . n, so each lies between the sums of the least and of the largest n d along each axis. A hit
/// has all three of one sign. Where one is below 0 for all rays, and another, or a third, above 0,
/// there is none. `bound` is leaf_filter.hpp's: of w's terms, too, none has ten roundings.
SPACE_INLINE unsigned triangles_met_by_any(const float* block, const PacketRays& rays) {
    Float4 a[3], e1[3], e2[3], s[3], n[3][3];
    for (int axis = 0; axis < 3; ++axis) {
        a[axis] = load<4>(block + 4 * axis);
        e1[axis] = load<4>(block + 4 * (axis + 3)) - a[axis];
        e2[axis] = load<4>(block + 4 * (axis + 6)) - a[axis];
        s[axis] = rays.near_origin[axis] - a[axis];
    }
    cross(e2, s, n[0]);
    cross(s, e1, n[1]);
    cross(e2, e1, n[2]);
    const Float4 n1 = one_norm(e1), n2 = one_norm(e2), ns = one_norm(s);
    const Float4 bound = 10.0f * 0x1p-24f * rays.longest * (n1 * n2 + (n1 + n2) * ns) + 0x1p-110f;
    for (int axis = 0; axis < 3; ++axis) n[2][axis] = n[2][axis] - n[0][axis] - n[1][axis];
    unsigned never_positive = 0, never_negative = 0;
    for (int volume = 0; volume < 3; ++volume) {
        Float4 least = all<4>(0.0f), most = least;
        for (int axis = 0; axis < 3; ++axis) {
            const Float4 low = n[volume][axis] * rays.direction_low[axis],
                         high = n[volume][axis] * rays.direction_high[axis];
            least = least + smaller(low, high);
            most = most + larger(low, high);
        }
        never_positive |= above(-bound, most);
        never_negative |= above(least, bound);
    }
    return 15u & ~(never_positive & never_negative);
}
// [packet_cull]

/// Up to so many rays a leaf's four triangles are tested for one ray after the other: a packet
/// whose rays have parted would test one triangle after the other, for lanes that are mostly empty.
constexpr unsigned few_rays = 3;

/// The same by the walk of single rays.
SPACE_INLINE bool test_leaf_singly(const KernelTree& tree, const char* block, PacketRays& rays,
                                   uint64_t some) {
    bool is_changed = false;
    for (; some != 0; some &= some - 1) {
        const unsigned i = unsigned(__builtin_ctzll(some));
        KernelRay& ray = rays.singles[i];
        if ((rays.prepared_singles >> i & 1) == 0) {
            prepared(tree, rays.rays + 8 * i, ray);
            rays.prepared_singles |= UINT64_C(1) << i;
        }
        KernelHit best{rays.t[i], rays.u[i], rays.v[i], rays.triangle[i]};
        const float after = float_after(best.t);
        const float ends = best.triangle != no_kernel_hit && after < ray.limit ? after : ray.limit;
        const unsigned lanes = filter_leaf<false>(block, ray, ends).may_hit;
        if (lanes == 0) continue;
        take_hits(tree, ray, block, lanes, best);
        if (best.triangle == rays.triangle[i]) continue;
        rays.t[i] = best.t;
        rays.u[i] = best.u;
        rays.v[i] = best.v;
        rays.triangle[i] = best.triangle;
        set_limit(rays, i);
        is_changed = true;
    }
    return is_changed;
}

/// A leaf's triangles, each against all rays that come to it.
template <bool has_one_origin>
SPACE_INLINE bool test_leaf(const KernelTree& tree, uint32_t child, PacketRays& rays, uint64_t some,
                            ExactPacketLane exact, PacketCounts& counts) {
    bool is_changed = false;
    const bool is_few = __builtin_popcountll(some) <= int(few_rays);
    const char* place = tree.blocks + (child & 0x0fffffff) * block_bytes;
    for (unsigned count = (child >> 28 & 7) + 1; count > 0; --count, place += block_bytes) {
        ++counts.blocks;
        if (is_few) {
            is_changed |= test_leaf_singly(tree, place, rays, some);
            continue;
        }
        const unsigned left =
            has_one_origin ? triangles_met_by_any(reinterpret_cast<const float*>(place), rays) : 15;
        for (unsigned lane = 0; lane < 4; ++lane) {
            if (reinterpret_cast<const uint32_t*>(place)[36 + lane] == ~UINT32_C(0)) break;
            if ((left >> lane & 1) == 0) continue;
            is_changed |= test_triangle<has_one_origin>(reinterpret_cast<const float*>(place), lane,
                                                        rays, some, exact);
        }
    }
    return is_changed;
}

}  // namespace
}  // namespace space::SPACE_ISA
