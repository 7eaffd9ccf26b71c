/// @file
/// What goes into the kernels for several rays at once: plain values, as in kernel_types.hpp.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/kernel_types.hpp"

#include <stddef.h>
#include <stdint.h>

namespace space {

inline constexpr uint32_t most_packet_rays = 64;

/// Rays side by side, whose directions have the same signs.
struct alignas(64) PacketRays {
    float origin[3][most_packet_rays], direction[3][most_packet_rays];
    /// Reciprocals of the direction, a little short for near planes, a little long for far ones.
    float near_inverse[3][most_packet_rays], far_inverse[3][most_packet_rays];
    float tmin[most_packet_rays], tmax[most_packet_rays];
    float limit[most_packet_rays];  ///< beyond it nothing matters to the ray
    /// The nearest hits so far: at infinity, by no triangle.
    float t[most_packet_rays], u[most_packet_rays], v[most_packet_rays];
    uint32_t triangle[most_packet_rays];

    /// All rays': of the origins those for which near planes are met first and far ones last; the
    /// ends of the reciprocals' ranges.
    float near_origin[3], far_origin[3], near_low[3], near_high[3], far_low[3], far_high[3];
    float direction_low[3], direction_high[3];  ///< the directions' ranges
    float longest;  ///< not below any direction's sum of sizes, but for roundings
    float least_tmin;
    uint32_t near_row[3], far_row[3];
    uint32_t count;             ///< of the rays; places behind them are over before they begin
    bool has_one_origin;        ///< as a camera's rays have
    bool is_any_asked;          ///< then the first hit ends a ray
    uint64_t prepared_singles;  ///< which of `singles` have been made: where few rays are left
    KernelRay singles[most_packet_rays];
    const float* rays;  ///< as they came: origin, direction, tmin, tmax
};

/// A ray's place in the packet puts one triangle of a block to chapter 2's exact test; a nearer hit
/// takes its place.
using ExactPacketLane = void (*)(PacketRays& rays, unsigned ray, const float* block, unsigned lane);

/// What walks of packets did.
struct PacketCounts {
    uint64_t nodes, blocks;
};

/// For one instruction set.
struct ManyKernels {
    /// Traces `rays.count` rays from `rays.rays`. False, and nothing is done, where one of them is
    /// not for kernels, is parallel to an axis' planes, or goes another way than the first.
    bool (*packet)(const KernelTree&, PacketRays& rays, float largest, ExactPacketLane,
                   PacketCounts&);
    /// So many rays, of which `together` are under way at a time.
    void (*interleaved)(const KernelTree&, const float* rays, KernelHit*, KernelAnswer*,
                        size_t count, unsigned together, bool is_any_asked);
    KernelTable compressed;  ///< one ray through a CompressedTree
    /// What a node, or a block, costs. Does so many, of so many (a power of two) that stand side by
    /// side: each after the one before it has told which is next, or all by themselves.
    uint32_t (*probe_nodes)(const KernelTree&, const float* ray, uint32_t count, size_t steps,
                            bool is_chained);
    uint32_t (*probe_blocks)(const KernelTree&, const float* ray, uint32_t count, size_t steps,
                             bool is_chained);
};

}  // namespace space
