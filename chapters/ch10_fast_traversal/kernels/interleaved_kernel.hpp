/// @file
/// Several walks in one thread, a step of each in turn: while one waits for memory, the others
/// compute.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/many_types.hpp"
#include "chapters/ch10_fast_traversal/kernels/wide_kernel.hpp"

namespace space::SPACE_ISA {
namespace {

constexpr unsigned most_together = 32;

/// A walk between two steps.
struct Walk {
    KernelRay ray;
    KernelHit best;
    size_t index;            ///< of the ray
    uint64_t *bottom, *top;  ///< what waits
    uint32_t child;          ///< what is next; it has been asked for
    float ends;              ///< the t beyond which nothing matters any more
    bool is_over;
};

/// The nearest of what waits, if it begins before the limit.
SPACE_INLINE void take_waiting(Walk& walk) {
    const uint32_t limit_bits = __builtin_bit_cast(uint32_t, walk.ends);
    do {
        if (walk.top == walk.bottom) {
            walk.is_over = true;
            return;
        }
        --walk.top;
    } while (uint32_t(*walk.top >> 32) > limit_bits);
    walk.child = uint32_t(*walk.top);
}

template <bool is_any_asked>
SPACE_INLINE void visit_leaf(const KernelTree& tree, Walk& walk) {
    for (WideLayout<8>::Leaf leaf(tree, walk.child); leaf.has_block(); leaf.take_next()) {
        const LeafLanes lanes = filter_leaf<is_any_asked>(leaf.block, walk.ray, walk.ends);
        if (lanes.may_hit == 0) continue;
        if (is_any_asked) {
            walk.is_over =
                lanes.must_hit != 0 || is_any_hit(tree, walk.ray, leaf.block, lanes.may_hit);
            if (walk.is_over) {
                walk.best.triangle = 0;
                return;
            }
        } else {
            walk.ends = take_hits(tree, walk.ray, leaf.block, lanes.may_hit, walk.best);
        }
    }
    take_waiting(walk);
}

// [interleaved]
/// A step of one walk: a node or a leaf, and what comes next is asked for.
template <bool is_any_asked>
SPACE_INLINE void step(const KernelTree& tree, Walk& walk) {
    if ((walk.child & leaf_bit) != 0) {
        visit_leaf<is_any_asked>(tree, walk);
    } else {
        const uint32_t* children;
        Float8 enter;
        const unsigned met = WideLayout<8>::met(tree, walk.child, node_ray_of<8>(walk.ray),
                                                all<8>(walk.ends), enter, children);
        if (met != 0)
            walk.child = nearest_of<8>(children, met, enter, walk.top);
        else
            take_waiting(walk);
    }
    if (!walk.is_over) FetchWaiting<WideLayout<8>>{tree}(walk.child);
}

/// The next ray that kernels take, if there is one left.
SPACE_INLINE bool begin_next(const KernelTree& tree, const float* rays, KernelAnswer* answers,
                             size_t count, size_t& next, Walk& walk) {
    for (; next < count; ++next) {
        if (!prepared(tree, rays + 8 * next, walk.ray)) {
            answers[next] = kernel_refuses;
            continue;
        }
        walk.best = nothing_yet;
        walk.index = next++;
        walk.top = walk.bottom;
        walk.child = tree.root;
        walk.ends = walk.ray.limit;
        walk.is_over = false;
        return true;
    }
    return false;
}

/// All rays, of which `together` are under way: where one is over, the next one begins.
template <bool is_any_asked>
SPACE_INLINE void walk_together(const KernelTree& tree, const float* rays, KernelHit* hits,
                                KernelAnswer* answers, size_t count, unsigned together) {
    uint64_t* const stacks = static_cast<uint64_t*>(
        __builtin_alloca(size_t(together) * tree.stack_size * sizeof(uint64_t)));
    Walk walks[most_together];
    size_t next = 0;
    unsigned under_way = 0;
    for (unsigned i = 0; i < together; ++i) {
        walks[i].bottom = stacks + size_t(i) * tree.stack_size;
        if (!begin_next(tree, rays, answers, count, next, walks[i])) break;
        ++under_way;
    }
    while (under_way > 0)
        for (unsigned i = 0; i < under_way; ++i) {
            Walk& walk = walks[i];
            step<is_any_asked>(tree, walk);
            if (!walk.is_over) continue;
            hits[walk.index] = walk.best;
            answers[walk.index] = walk.best.triangle != no_kernel_hit ? kernel_hit : kernel_miss;
            if (!begin_next(tree, rays, answers, count, next, walk))
                walks[i--] = walks[--under_way];
        }
}
// [interleaved]

void walk_interleaved(const KernelTree& tree, const float* rays, KernelHit* hits,
                      KernelAnswer* answers, size_t count, unsigned together, bool is_any_asked) {
    if (together > most_together) together = most_together;
    if (together < 1) together = 1;
    if (is_any_asked)
        walk_together<true>(tree, rays, hits, answers, count, together);
    else
        walk_together<false>(tree, rays, hits, answers, count, together);
}

}  // namespace
}  // namespace space::SPACE_ISA
