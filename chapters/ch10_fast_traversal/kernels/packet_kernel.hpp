/// @file
/// Rays side by side: a node is fetched once for a packet of up to 64 rays, and a triangle is
/// tested against as many as a register holds.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/many_types.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_boxes.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_lanes.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_leaf.hpp"
#include "chapters/ch10_fast_traversal/kernels/packet_rays.hpp"
#include "chapters/ch10_fast_traversal/kernels/wide_kernel.hpp"

namespace space::SPACE_ISA {
namespace {

/// A child that waits for some of the rays, none of which enters it before `enter`.
struct WaitingChild {
    uint64_t rays;
    float enter;
    uint32_t child;
};

/// Those of some rays that are not over before `enter`.
SPACE_INLINE uint64_t rays_not_over(const PacketRays& rays, uint64_t some, float enter) {
    uint64_t left = 0;
    for (unsigned first = 0; first < rays.count; first += ray_lanes)
        left |= uint64_t(at_most(RayFloats{} + enter, rays_at(rays.limit + first))) << first;
    return left & some;
}
SPACE_INLINE float most_limit(const PacketRays& rays) {
    RayFloats most = rays_at(rays.limit);
    for (unsigned first = ray_lanes; first < rays.count; first += ray_lanes)
        most = larger(most, rays_at(rays.limit + first));
    float limit = most[0];
    for (unsigned i = 1; i < ray_lanes; ++i) limit = most[i] > limit ? most[i] : limit;
    return limit;
}

/// The children of a node that rays meet, onto the stack, the one that is entered first on top.
template <bool has_one_origin>
SPACE_INLINE WaitingChild* push_children(const KernelTree& tree, uint32_t index,
                                         const PacketRays& rays, const PacketSpan& span,
                                         uint64_t some, float most, WaitingChild* top) {
    const FetchWaiting<WideLayout<8>> fetch{tree};
    const char* const node = tree.nodes + size_t(index) * 256;
    Float8 enter;
    unsigned met = children_met_by_any(node, span, all<8>(most), enter);
    if (met == 0) return top;
    alignas(32) float enters[8];
    *reinterpret_cast<Float8*>(enters) = enter;
    const uint32_t* const children = reinterpret_cast<const uint32_t*>(node + 192);
    WaitingChild* const bottom = top;
    for (; met != 0; met &= met - 1) {
        const unsigned child = unsigned(__builtin_ctz(met));
        const uint64_t meeting = rays_that_meet<has_one_origin>(node, child, rays, span, some);
        if (meeting == 0) continue;
        fetch(children[child]);
        WaitingChild* place = top++;
        for (; place != bottom && place[-1].enter < enters[child]; --place) *place = place[-1];
        *place = {meeting, enters[child], children[child]};
    }
    return top;
}

// [packets]
/// One walk for all rays of the packet: a node is for those that meet it.
template <bool has_one_origin>
[[gnu::noinline]] void walk_packet(const KernelTree& tree, PacketRays& rays, ExactPacketLane exact,
                                   PacketCounts& counts) {
    const PacketSpan span = span_of(rays);
    WaitingChild* const bottom =
        static_cast<WaitingChild*>(__builtin_alloca(tree.stack_size * sizeof(WaitingChild)));
    WaitingChild* top = bottom;
    *top++ = {~UINT64_C(0) >> (64 - rays.count), 0.0f, tree.root};
    float most = most_limit(rays);
    while (top != bottom) {
        const WaitingChild waiting = *--top;
        if (!(waiting.enter <= most)) continue;
        const uint64_t some = rays_not_over(rays, waiting.rays, waiting.enter);
        if (some == 0) continue;
        if ((waiting.child & leaf_bit) == 0) {
            ++counts.nodes;
            top = push_children<has_one_origin>(tree, waiting.child, rays, span, some, most, top);
        } else if (test_leaf<has_one_origin>(tree, waiting.child, rays, some, exact, counts)) {
            most = most_limit(rays);
        }
    }
}
// [packets]

bool trace_packet(const KernelTree& tree, PacketRays& rays, float largest, ExactPacketLane exact,
                  PacketCounts& counts) {
    if (!prepare_packet(rays, largest)) return false;
    if (rays.has_one_origin)
        walk_packet<true>(tree, rays, exact, counts);
    else
        walk_packet<false>(tree, rays, exact, counts);
    return true;
}

}  // namespace
}  // namespace space::SPACE_ISA
