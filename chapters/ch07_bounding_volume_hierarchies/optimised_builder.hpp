/// @file
/// A tree made better: subtrees are taken out and put back where they cost least (Bittner, Hapala &
/// Havran 2013, "Fast Insertion-Based Optimization of Bounding Volume Hierarchies"), the best place
/// found by a search from the old one outwards (Meister & Bittner 2018, "Parallel Reinsertion for
/// Bounding Volume Hierarchy Optimization"), here one after the other.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_layout.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// A tree while its subtrees are moved. Pairs stay pairs; in which order they stand is lost.
template <int D>
class BvhReinsertion {
  public:
    /// Event: a subtree has moved below a new node.
    struct Moved {
        const BvhNodes<D>& tree;
        std::uint32_t node, place;  ///< the subtree's root, and the node above it
        double saved;               ///< of the weights of all inner nodes
    };

    explicit BvhReinsertion(BvhNodes<D> tree)
        : tree_(std::move(tree)), chance_(tree_.nodes[0].box), parents_(tree_.nodes.size() / 2) {
        unite_boxes(tree_);
        for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i)
            if (i != 1) put(i, tree_.nodes[i]);
    }
    const BvhNodes<D>& tree() const { return tree_; }

    // [reinsert]
    /// Moves each of the largest nodes, a share of all, where that saves something: the weights of
    /// all inner nodes, in sum, are what rays pay. Returns what has been saved.
    template <class Observer>
    double reinsert(double share, Observer& observer) {
        double saved = 0.0;
        for (const std::uint32_t node : largest(share)) {
            const Place best = best_place(node);
            if (!(best.saved > 0.0)) continue;
            move(node, best.node);
            saved += best.saved;
            observer.observe(Moved{tree_, tree_.nodes[best.node].first + 1, best.node, best.saved});
        }
        return saved;
    }
    // [reinsert]

    /// Where a subtree may go: a new node around it and this one, which saves so much.
    struct Place {
        std::uint32_t node = 0;
        double saved = 0.0;
    };

    // [best_place]
    /// From the old place up to the root, and down beside each node on the way. Without the moved
    /// subtree its parent is no longer needed, and those above become smaller, where it does not
    /// come back below them.
    Place best_place(std::uint32_t moved) {
        Place best;
        BasicAabb<D> rest;  // of what is below the node on the way, without the moved
        double saved = weight(parent(moved));
        for (std::uint32_t way = moved;; way = parent(way)) {
            if (way != moved && way != parent(moved)) {
                const double smaller = chance_.weight(rest);
                // A new node around both would be as large as this one was.
                consider(best, {way, saved - smaller});
                saved += weight(way) - smaller;
            }
            if (way == 0) return best;
            search_below(sibling(way), moved, saved, best);
            rest.extend(box(sibling(way)));
        }
    }
    // [best_place]

    // [move]
    /// The sibling takes its parent's place, and so a pair is free. It becomes the children of the
    /// new node: what was in that place, and the moved.
    void move(std::uint32_t moved, std::uint32_t place) {
        const std::uint32_t above = parent(moved), pair = moved & ~1u;
        const BvhNode<D> subtree = node(moved);
        put(above, node(sibling(moved)));
        if (above != 0) tighten(parent(above));
        put(pair, node(place));
        put(pair + 1, subtree);
        put(place, {.box = {}, .first = pair, .count = 0});
        tighten(place);
    }
    // [move]

  private:
    BvhNode<D>& node(std::uint32_t index) { return tree_.nodes[index]; }
    const BasicAabb<D>& box(std::uint32_t index) const { return tree_.nodes[index].box; }
    double weight(std::uint32_t index) const { return chance_.weight(box(index)); }
    double weight_of_both(const BasicAabb<D>& one, const BasicAabb<D>& other) const {
        BasicAabb<D> both = one;
        both.extend(other);
        return chance_.weight(both);
    }
    std::uint32_t parent(std::uint32_t index) const { return parents_[index / 2]; }
    static std::uint32_t sibling(std::uint32_t index) { return index ^ 1u; }

    std::vector<std::uint32_t> largest(double share) const {
        std::vector<std::pair<double, std::uint32_t>> all;
        for (std::uint32_t i = 2; i < tree_.nodes.size(); ++i) all.emplace_back(-weight(i), i);
        std::sort(all.begin(), all.end());
        if (!(share > 0.0)) return {};
        all.resize(static_cast<std::size_t>(std::min(share, 1.0) * double(all.size())));
        std::vector<std::uint32_t> nodes;
        for (const auto& [less, i] : all) nodes.push_back(i);
        return nodes;
    }

    // [search_below]
    /// Below a node to which the moved does not belong. `saved` is what is left when all above it
    /// have grown as they must.
    void search_below(std::uint32_t top, std::uint32_t moved, double saved, Place& best) {
        const double least = weight(moved);  // of any node around it and another
        waiting_.assign(1, {top, saved});
        while (!waiting_.empty()) {
            const Place at = waiting_.back();
            waiting_.pop_back();
            if (at.saved - least <= best.saved) continue;
            const double both = weight_of_both(box(at.node), box(moved));
            consider(best, {at.node, at.saved - both});
            const double left = at.saved - (both - weight(at.node));
            if (tree_.nodes[at.node].is_leaf() || left - least <= best.saved) continue;
            waiting_.push_back({tree_.nodes[at.node].first, left});
            waiting_.push_back({tree_.nodes[at.node].first + 1, left});
        }
    }
    static void consider(Place& best, const Place& place) {
        if (place.saved > best.saved) best = place;
    }
    // [search_below]

    void put(std::uint32_t index, BvhNode<D> content) {
        node(index) = content;
        if (!content.is_leaf()) parents_[content.first / 2] = index;
    }
    /// The boxes from here up, as far as they change.
    void tighten(std::uint32_t index) {
        for (;; index = parent(index)) {
            BasicAabb<D> both = box(node(index).first);
            both.extend(box(node(index).first + 1));
            if (both == box(index)) return;
            node(index).box = both;
            if (index == 0) return;
        }
    }

    BvhNodes<D> tree_;
    HitChance<D> chance_;
    std::vector<std::uint32_t> parents_;  ///< of each pair
    std::vector<Place> waiting_;          ///< of a search, kept for its memory
};

/// Costs, limits, how much a round tries, and when to end.
struct OptimisedConfig {
    BvhCosts costs = {};
    std::size_t max_leaf_size = 8;  ///< nodes are merged into leaves where that pays
    double share = 0.3;             ///< of the nodes, the largest, that a round tries to move
    double min_gain = 0.01;         ///< the share of the cost below which a round is the last
    unsigned max_rounds = 8;
};

/// Reinsertion over a binned tree, round after round.
struct OptimisedBuilder {
    using Config = OptimisedConfig;

    // [optimised_build]
    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        const BinnedBuilder::Config singly{.costs = {0.0, 1.0}, .max_leaf_size = 1};
        return improved(BinnedBuilder::build<D>(polygons, singly), config, observer);
    }

    /// Any tree, made better.
    template <int D, class Observer = NoObserver>
    static BvhNodes<D> improved(BvhNodes<D> tree, const Config& config, Observer&& observer = {}) {
        if (tree.size() < 2) return tree;
        double cost = tree.sah_cost(config.costs) * HitChance<D>(tree.nodes[0].box).whole();
        BvhReinsertion<D> reinsertion(std::move(tree));
        for (unsigned round = 0; round < config.max_rounds; ++round) {
            const double saved =
                config.costs.traversal * reinsertion.reinsert(config.share, observer);
            if (!(saved > 0.0) || saved < config.min_gain * cost) break;
            cost -= saved;
        }
        return BvhLayout<D>::of(reinsertion.tree(), {config.costs, config.max_leaf_size});
    }
    // [optimised_build]
};

}  // namespace space
