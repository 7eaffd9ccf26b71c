/// @file
/// From the leaves up (Walter et al. 2008, "Fast Agglomerative Clustering for Rendering"): what is
/// nearest goes together. Neighbours are looked for in Morton order only, a few places to each side
/// (Meister & Bittner 2018, "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy
/// Construction").
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_layout.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// Costs, limits, and how far neighbours are sought.
struct BottomUpConfig {
    BvhCosts costs = {};
    std::size_t max_leaf_size = 8;  ///< nodes are merged into leaves where that pays
    std::uint32_t radius = 16;      ///< how many places to each side neighbours are looked for
    /// From then on each two that stand side by side are merged. Some 40 rounds are enough
    /// where each merges a fair part; a scene may be made so that it takes one for each node.
    unsigned max_rounds = 128;
};

/// Rounds of looking for neighbours and merging, until one node is left.
struct BottomUpBuilder {
    using Config = BottomUpConfig;
    /// Event: two nodes become the children of one with this box.
    template <int D>
    struct Merged {
        const BvhNode<D>&one, &other;
        const BasicAabb<D>& box;
        unsigned round;
    };

    // [bottom_up_build]
    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        const std::vector<BvhReference<D>> references = boxed<D>(polygons);
        if (references.empty()) return {};
        BvhNodes<D> tree;
        tree.nodes.reserve(2 * references.size());
        tree.nodes.resize(2);
        std::vector<BvhNode<D>> tops;  // of the trees so far, in Morton order
        for (const std::uint32_t i : MortonBuilder::order_of<D>(references).indices) {
            tops.push_back({references[i].box, static_cast<std::uint32_t>(tops.size()), 1});
            tree.references.push_back(references[i].polygon);
        }
        const HitChance<D> chance(box_around<D>(references));
        std::vector<Neighbour> nearest;
        for (unsigned round = 0; tops.size() > 1; ++round) {
            if (round < config.max_rounds)
                find_nearest<D>(tops, config.radius, chance, nearest);
            else
                take_next(tops.size(), nearest);
            merge_mutual<D>(tops, nearest, tree, round, observer);
        }
        tree.nodes[0] = tops.front();
        return BvhLayout<D>::of(tree, {config.costs, config.max_leaf_size});
    }
    // [bottom_up_build]

  private:
    /// Of two nodes the weight of the box around both, and which the other one is.
    struct Neighbour {
        double weight;
        std::uint32_t place;
    };

    // [find_nearest]
    /// Of equally near neighbours i and j those first for which i xor j is the least. That is the
    /// same seen from both, and no two neighbours of one node have it in common: so the nearest two
    /// of all are each other's nearest, and each round merges something; where all are equally
    /// near, half of them.
    template <int D>
    static void find_nearest(std::span<const BvhNode<D>> tops, std::uint32_t radius,
                             const HitChance<D>& chance, std::vector<Neighbour>& nearest) {
        const auto size = static_cast<std::uint32_t>(tops.size());
        nearest.assign(size, {infinity, 0});
        const auto offer = [&](std::uint32_t to, std::uint32_t place, double weight) {
            Neighbour& best = nearest[to];
            if (std::pair(weight, to ^ place) < std::pair(best.weight, to ^ best.place))
                best = {weight, place};
        };
        for (std::uint32_t i = 0; i < size; ++i)
            for (std::uint32_t j = i + 1; j < size && j - i <= std::max(radius, 1u); ++j) {
                BasicAabb<D> both = tops[i].box;
                both.extend(tops[j].box);
                const double weight = chance.weight(both);
                offer(i, j, weight);
                offer(j, i, weight);
            }
    }
    // [find_nearest]

    static void take_next(std::size_t size, std::vector<Neighbour>& nearest) {
        nearest.assign(size, {});
        for (std::uint32_t i = 0; i < size; ++i)
            nearest[i].place = (i ^ 1u) < size ? i ^ 1u : i;  // the last may be alone
    }

    // [merge_mutual]
    /// Those that are each other's nearest become a pair, and a node above them takes the place of
    /// the first.
    template <int D, class Observer>
    static void merge_mutual(std::vector<BvhNode<D>>& tops, std::span<const Neighbour> nearest,
                             BvhNodes<D>& tree, unsigned round, Observer& observer) {
        std::size_t kept = 0;
        for (std::uint32_t i = 0; i < nearest.size(); ++i) {
            const std::uint32_t other = nearest[i].place;
            const bool is_mutual = other != i && nearest[other].place == i;
            if (is_mutual && other < i) continue;  // it has been merged
            BvhNode<D> top = tops[i];
            if (is_mutual) {
                const auto pair = static_cast<std::uint32_t>(tree.nodes.size());
                tree.nodes.push_back(tops[i]);
                tree.nodes.push_back(tops[other]);
                top = {tops[i].box, pair, 0};
                top.box.extend(tops[other].box);
                observer.observe(Merged<D>{tops[i], tops[other], top.box, round});
            }
            tops[kept++] = top;
        }
        tops.resize(kept);
    }
    // [merge_mutual]
};

}  // namespace space
