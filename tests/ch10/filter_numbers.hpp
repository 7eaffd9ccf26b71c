/// @file
/// The numbers of chapter 10's filter of a leaf, lane by lane, by each of its two compilations.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/kernel_types.hpp"

namespace space {

/// Of one lane, as LeafVolumes.
struct FilterNumbersOfLane {
    float size, u, v, t, bound, late, early;
};
using FilterNumbers = FilterNumbersOfLane[4];

/// Bits of four lanes, as LeafLanes.
struct FilterMasks {
    unsigned may_hit, must_hit;
};

namespace plain_filter {
void filter_numbers(const float* block, const KernelRay& ray, FilterNumbers& result);
void filter_masks(const float* block, const KernelRay& ray, FilterMasks& result);
}  // namespace plain_filter
namespace fused_filter {  // for processors with AVX2 alone
void filter_numbers(const float* block, const KernelRay& ray, FilterNumbers& result);
void filter_masks(const float* block, const KernelRay& ray, FilterMasks& result);
}  // namespace fused_filter

}  // namespace space
