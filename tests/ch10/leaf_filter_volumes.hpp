/// @file
/// What the filter of a leaf computes, put where a test can read it. The including file defines
/// SPACE_ISA; like the kernels it has no inline function of others.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/leaf_filter.hpp"
#include "tests/ch10/filter_numbers.hpp"

namespace space::SPACE_ISA {

void filter_numbers(const float* block, const KernelRay& ray, FilterNumbers& result) {
    const LeafVolumes of = volumes_of(reinterpret_cast<const char*>(block), ray, ray.limit);
    for (int lane = 0; lane < 4; ++lane)
        result[lane] = {of.size[lane],  of.u[lane],    of.v[lane],    of.t[lane],
                        of.bound[lane], of.late[lane], of.early[lane]};
}
void filter_masks(const float* block, const KernelRay& ray, FilterMasks& result) {
    const LeafLanes lanes = filter_leaf<true>(reinterpret_cast<const char*>(block), ray, ray.limit);
    result = {lanes.may_hit, lanes.must_hit};
}

}  // namespace space::SPACE_ISA
