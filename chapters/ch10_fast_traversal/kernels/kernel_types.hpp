/// @file
/// What goes into a kernel and comes out of it: plain values of plain types. The kernels' files are
/// compiled for different processors, and whatever inline function of others they used, the linker
/// might keep one that this processor cannot run. So they use none, and this file has none.
#pragma once

#include <stddef.h>
#include <stdint.h>

namespace space {

/// A ray as kernels take it; prepare_kernel_ray makes it.
struct KernelRay {
    float origin[3], direction[3];
    // [kernel_ray]
    /// The plane at p across an axis is met at p * scale + shift, which is a little less than t for
    /// near planes and a little more for far ones: never on the wrong side of the exact t.
    float near_scale[3], near_shift[3], far_scale[3], far_shift[3];
    uint32_t near_row[3], far_row[3];  ///< of a node's rows: which are near, which far
    // [kernel_ray]
    float tmin, tmax;
    float limit;             ///< the least float that is no t of a hit: above tmax
    float direction_length;  ///< of the direction: the sum of its components' sizes
};

/// The nearest hit so far.
struct KernelHit {
    float t, u, v;
    uint32_t triangle;  ///< no_kernel_hit before the first
};
inline constexpr uint32_t no_kernel_hit = ~UINT32_C(0);

struct KernelTree;

/// Puts one triangle of a block to chapter 2's exact test; a nearer hit takes the place of `best`.
/// @return the t beyond which nothing matters any more
using ExactLane = float (*)(const KernelRay& ray, const float* block, unsigned lane,
                            KernelHit& best);

/// Where a tree lies in memory.
struct KernelTree {
    const char* nodes;
    const char* blocks;
    uint32_t root;
    uint32_t stack_size;  ///< places that the walk may need
    ExactLane exact;
};

/// One width, one instruction set.
struct KernelTable {
    void (*closest)(const KernelTree&, const KernelRay&, KernelHit& best);
    bool (*any)(const KernelTree&, const KernelRay&);
};

}  // namespace space
