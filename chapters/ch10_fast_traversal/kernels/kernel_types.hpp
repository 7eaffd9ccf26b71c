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
    // Each has a fourth place, so that three are written as four.
    float origin[4], direction[4];
    // [kernel_ray]
    /// The near plane at p across an axis is met at (p - near_origin) near_scale, which is no more
    /// than the exact t, the far plane at (p - far_origin) far_scale, which is no less. Both
    /// origins are the ray's but where it is parallel to the planes.
    float near_origin[4], near_scale[4], far_origin[4], far_scale[4];
    uint32_t near_row[3], far_row[3];  ///< of a node's rows: which are near, which far
    // [kernel_ray]
    float tmin, tmax;
    float before, limit;     ///< before and after every t of a hit
    float direction_length;  ///< of the direction: the sum of its components' sizes
};

/// The nearest hit so far.
struct KernelHit {
    float t, u, v;
    uint32_t triangle;  ///< no_kernel_hit before the first
};
inline constexpr uint32_t no_kernel_hit = ~UINT32_C(0);
inline constexpr KernelHit nothing_yet{__builtin_inff(), 0.0f, 0.0f, no_kernel_hit};

struct KernelTree;

/// Puts one triangle of a block to chapter 2's exact test; a nearer hit takes the place of `best`.
using ExactLane = void (*)(const KernelRay& ray, const float* block, unsigned lane,
                           KernelHit& best);

/// Makes a KernelRay of a ray's eight floats: origin, direction, tmin, tmax. False where kernels
/// cannot take it.
using PrepareRay = bool (*)(const float* ray, float largest, KernelRay& prepared);

/// Where a tree lies in memory, and what its kernels ask of others.
struct KernelTree {
    const char* nodes;
    const char* blocks;
    uint32_t root;
    uint32_t stack_size;  ///< places that the walk may need
    float largest;        ///< size of a coordinate of the tree
    ExactLane exact;
    PrepareRay prepare;
    const float* corners = nullptr;  ///< of a compressed tree, three floats each
};

/// What a kernel says of a ray.
enum KernelAnswer : int { kernel_miss, kernel_hit, kernel_refuses };

/// One width, one instruction set.
struct KernelTable {
    KernelAnswer (*closest)(const KernelTree&, const float* ray, KernelHit& best);
    KernelAnswer (*any)(const KernelTree&, const float* ray);
};

}  // namespace space
