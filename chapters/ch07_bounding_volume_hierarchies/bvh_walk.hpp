/// @file
/// The walk of a ray through a tree of boxes: the nearer child first, and nothing that begins
/// beyond the nearest hit.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_ray.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace space {

/// How a ray walks.
struct BvhWay {
    enum class Order {
        nearest_first,  ///< of two children that the ray meets; and ended early by hits
        all_boxes,      ///< as it is often printed: every box that the ray meets, and no early end
    };
    Order order = Order::nearest_first;
    BoxMargins margins = BoxMargins::conservative;
};

/// Event: the walk has come to a node, whose box the ray enters here.
struct BvhVisit {
    std::uint32_t node;
    double enter;
};

// [walk_nearest_first]
/// Calls own(leaf) for each leaf on the way; it returns the t beyond which nothing matters any
/// more, the limit (NaN: nothing at all). Boxes overlap, so a hit ends nothing that begins before
/// it. What begins *at* the limit is still visited: equal t is the tie rule's to decide.
template <int D, class WalkRay, class Counts, class Own, class Observer>
void walk_nearest_first(const BvhNodes<D>& tree, const WalkRay& ray, Counts& counts, const Own& own,
                        Observer&& observer) {
    using Real = typename WalkRay::Real;
    struct Waiting {
        std::uint32_t node;
        Real enter;
    };
    std::array<Waiting, max_bvh_depth> waiting;  // far children, at most one a level
    std::size_t size = 0;
    const BvhNode<D>* const nodes = tree.nodes.data();
    Real limit = ray.limit();
    const auto root = ray.span_in(nodes[0].box, limit);
    if (!root.is_met()) return;
    Waiting in_hand{0, root.enter};
    for (;;) {
        const BvhNode<D>& node = nodes[in_hand.node];
        counts.visit_node();
        observer.observe(BvhVisit{in_hand.node, double{in_hand.enter}});
        if (!node.is_leaf()) {
            const auto a = ray.span_in(nodes[node.first].box, limit);
            const auto b = ray.span_in(nodes[node.first + 1].box, limit);
            Waiting near{node.first, a.enter}, far{node.first + 1, b.enter};
            if (a.is_met() && b.is_met()) {
                if (far.enter < near.enter) std::swap(near, far);
                waiting[size++] = far;
            }
            if (a.is_met() || b.is_met()) {
                in_hand = a.is_met() ? near : far;
                continue;
            }
        } else {
            // The ray's own end stays a limit, too. (min(NaN, limit) is NaN.)
            limit = std::min(static_cast<Real>(own(node)), limit);
        }
        do {
            if (size == 0) return;
            in_hand = waiting[--size];
        } while (!(in_hand.enter <= limit));
    }
}
// [walk_nearest_first]

// [walk_all_boxes]
/// The same as it is often printed: both children always. The limit ends the walk when it is not a
/// number, and nothing before.
template <int D, class WalkRay, class Counts, class Own, class Observer>
void walk_all_boxes(const BvhNodes<D>& tree, const WalkRay& ray, Counts& counts, const Own& own,
                    Observer&& observer) {
    std::array<std::uint32_t, max_bvh_depth + 1> waiting{0};
    std::size_t size = 1;
    while (size > 0) {
        const std::uint32_t index = waiting[--size];
        const BvhNode<D>& node = tree.nodes[index];
        const auto span = ray.span_in(node.box, ray.limit());
        if (!span.is_met()) continue;
        counts.visit_node();
        observer.observe(BvhVisit{index, double{span.enter}});
        if (!node.is_leaf()) {
            waiting[size++] = node.first + 1;
            waiting[size++] = node.first;
        } else if (std::isnan(own(node))) {
            return;
        }
    }
}
// [walk_all_boxes]

/// Walks any ray by one of the ways; tells the observer every node (BvhVisit).
template <BvhWay way = BvhWay{}, int D, class Counts, class Own, class Observer = NoObserver>
void walk_bvh(const BvhNodes<D>& tree, const BasicRay<D>& ray, Counts& counts, const Own& own,
              Observer&& observer = {}) {
    if (tree.empty() || !is_valid(ray)) return;
    const auto walk = [&](const auto& prepared) {
        if constexpr (way.order == BvhWay::Order::nearest_first)
            walk_nearest_first(tree, prepared, counts, own, observer);
        else
            walk_all_boxes(tree, prepared, counts, own, observer);
    };
    const BvhRay<D> prepared(ray, way.margins);
    if (way.margins == BoxMargins::none || prepared.is_safe(ray, tree.nodes[0].box))
        walk(prepared);
    else
        walk(BvhDoubleRay<D>(ray));
}

}  // namespace space
