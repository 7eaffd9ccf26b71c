/// @file
/// The kernels by width and instruction set; and what they are given.
#pragma once

#include "chapters/ch10_fast_traversal/instruction_set.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_types.hpp"
#include "common/geometry.hpp"

namespace space {

/// The kernels for nodes of N = 4 or 8 children; none for InstructionSet::scalar.
template <int N>
const KernelTable* kernel_table(InstructionSet set);

/// Floats within which the kernels' bounds hold: sums and products of three do not overflow.
inline constexpr float largest_kernel_float = 0x1p30f;

/// False where a ray, or a tree whose largest coordinate has this size, is not one for kernels:
/// then walk_wide_any takes it.
bool prepare_kernel_ray(const Ray& ray, float largest, KernelRay& prepared);

/// The same of a ray's eight floats.
bool prepare_kernel_floats(const float* ray, float largest, KernelRay& prepared);

/// By FilteredExact.
void exact_lane(const KernelRay& ray, const float* block, unsigned lane, KernelHit& best);

}  // namespace space
