/// @file
/// What a walk's two steps cost by themselves: how long each takes where it waits for the one
/// before it, and how many are done in a time where none waits.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/many_types.hpp"
#include "chapters/ch10_fast_traversal/kernels/wide_kernel.hpp"

namespace space::SPACE_ISA {
namespace {

// [probe]
/// Slab tests of eight boxes. In the chain a node's word, which the test and the order choose,
/// names the next node.
uint32_t probe_nodes(const KernelTree& tree, const float* floats, uint32_t count, size_t steps,
                     bool is_chained) {
    KernelRay ray;
    if (!prepared(tree, floats, ray)) return 0;
    const NodeRay<8> node_ray = node_ray_of<8>(ray);
    const Float8 limit = all<8>(ray.limit);
    uint64_t stack[8];
    uint32_t node = 0, sum = 0;
    for (size_t i = 0; i < steps; ++i) {
        const uint32_t* children;
        Float8 enter;
        const unsigned met = WideLayout<8>::met(tree, node, node_ray, limit, enter, children);
        if (is_chained) {
            uint64_t* top = stack;
            node = nearest_of<8>(children, met | 1, enter, top) & (count - 1);
        } else {
            sum += met;
            node = (node + 1) & (count - 1);
        }
    }
    return sum + node;
}

/// Filters of four triangles. In the chain the number of those that are left names the next block.
uint32_t probe_blocks(const KernelTree& tree, const float* floats, uint32_t count, size_t steps,
                      bool is_chained) {
    KernelRay ray;
    if (!prepared(tree, floats, ray)) return 0;
    uint32_t block = 0, sum = 0;
    for (size_t i = 0; i < steps; ++i) {
        const LeafLanes lanes =
            filter_leaf<false>(tree.blocks + block * block_bytes, ray, ray.limit);
        sum += lanes.may_hit;
        block = (block + 1 + (is_chained ? lanes.may_hit : 0)) & (count - 1);
    }
    return sum + block;
}
// [probe]

}  // namespace
}  // namespace space::SPACE_ISA
