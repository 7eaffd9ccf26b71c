/// @file
/// The walk through a wide tree in plain C++, one child after the other: what the kernels do, for
/// readers; and what rays take that floats cannot serve.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_ray.hpp"
#include "chapters/ch10_fast_traversal/wide_tree.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace space {

/// Event: a node has been tested. Its children that the ray meets, the nearest first.
template <int N>
struct WideVisit {
    /// A child that the ray meets.
    struct Met {
        std::size_t place;  ///< in the node
        double enter;
    };
    std::uint32_t node;
    std::array<Met, N> met;
    std::size_t size;
};

/// Event: the walk has come to a leaf.
struct WideLeafVisit {
    WideChild leaf;
    double enter;
};

/// Event: what had waited begins beyond the limit by now.
struct WideSkipped {
    WideChild child;
    double enter;
};

/// At most so many edges from the root to a leaf: so much room has the stack of the walk below.
inline constexpr unsigned max_wide_depth = 160;

// [wide_walk_scalar]
/// Calls own(block) for the blocks of each leaf on the way; it returns the t beyond which nothing
/// matters any more (NaN: nothing at all).
template <class Tree, class WalkRay, class Counts, class Own, class Observer>
void walk_wide(const Tree& tree, const WalkRay& ray, Counts& counts, const Own& own,
               Observer&& observer) {
    constexpr std::size_t N = Tree::width;
    using Real = typename WalkRay::Real;
    struct Waiting {
        WideChild child;
        Real enter;
    };
    std::array<Waiting, max_wide_depth*(N - 1) + N> waiting;
    std::size_t size = 0;
    Real limit = ray.limit();
    Waiting in_hand{tree.root, ray.span_in(tree.box, limit).enter};
    for (;;) {
        if (!in_hand.child.is_leaf()) {
            const auto& node = tree.nodes[in_hand.child.index()];
            counts.visit_node();
            std::array<typename WideVisit<N>::Met, N> met;
            std::size_t many = 0;
            for (std::size_t i = 0; i < N; ++i) {
                if (!node.is_used(i)) continue;
                const auto span = ray.span_in(node.box(i), limit);
                if (!span.is_met()) continue;
                std::size_t place = many++;  // sorted as they come
                for (; place > 0 && double{span.enter} < met[place - 1].enter; --place)
                    met[place] = met[place - 1];
                met[place] = {i, double{span.enter}};
            }
            observer.observe(WideVisit<N>{in_hand.child.index(), met, many});
            for (std::size_t i = many; i-- > 0;)  // the nearest last, to be taken first
                waiting[size++] = {node.children[met[i].place], static_cast<Real>(met[i].enter)};
        } else {
            observer.observe(WideLeafVisit{in_hand.child, double{in_hand.enter}});
            counts.visit_node();
            const bool goes_on = tree.each_block(in_hand.child, [&](const TriangleBlock& block) {
                const auto ends = own(block);
                limit = std::min(static_cast<Real>(ends), limit);  // NaN stays
                return !std::isnan(ends);
            });
            if (!goes_on) return;
        }
        for (;; observer.observe(WideSkipped{in_hand.child, double{in_hand.enter}})) {
            if (size == 0) return;
            in_hand = waiting[--size];
            if (in_hand.enter <= limit) break;
        }
    }
}
// [wide_walk_scalar]

/// Walks any ray.
template <class Tree, class Counts, class Own, class Observer = NoObserver>
void walk_wide_any(const Tree& tree, const Ray& ray, Counts& counts, const Own& own,
                   Observer&& observer = {}) {
    if (tree.empty() || !is_valid(ray)) return;
    const BvhRay<3> prepared(ray);
    if (prepared.is_safe(ray, tree.box))
        walk_wide(tree, prepared, counts, own, observer);
    else
        walk_wide(tree, BvhDoubleRay<3>(ray), counts, own, observer);
}

}  // namespace space
