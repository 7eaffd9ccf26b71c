/// @file
/// Which nodes of a binary tree become the children of which wide node: by least cost (dynamic
/// programming, after Ylitie, Karras & Laine 2017, "Efficient Incoherent Ray Traversal on GPUs
/// Through Compressed Wide BVHs", section 3.1), or greedily.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace space {

/// What a collapse may choose.
struct CollapseConfig {
    /// How a wide node gets its children.
    enum class Way {
        least_cost,  ///< the best of all ways
        greedy,      ///< the child with the largest box is opened, until all places are taken
    };
    Way way = Way::least_cost;
    double node_cost = 1.0;      ///< of a wide node, however many children it has
    double block_cost = 0.8;     ///< of a block of triangles, however many it holds
    std::size_t max_leaf = 4;    ///< triangles of a leaf that is made of several
    std::size_t block_size = 4;  ///< triangles that are tested at once
};

/// The choice for each node of a binary tree of segments or triangles, at most N children a node.
template <int N, int D>
class CollapseChoice {
  public:
    /// Of the part of the tree below one node. places = 1 .. N.
    struct Row {
        /// cost[i - 1]: the least of all ways to hang what is below into at most i places of a node
        /// above.
        std::array<float, N> cost;
        /// opened[i - 1]: how many of i places are really used, 1 where the node itself takes one.
        std::array<std::uint8_t, N> opened;
        /// first[i - 1]: of i places that are all used, those of the first child.
        std::array<std::uint8_t, N> first;
        std::uint32_t references;
        std::uint8_t places;  ///< that can be used: leaves below, at most N; more cost the same
        bool is_leaf;         ///< where it takes one place: a leaf, not a wide node
    };

    CollapseChoice(const BvhNodes<D>& tree, const CollapseConfig& config)
        : tree_(tree), config_(config), chance_(tree.nodes[0].box), rows_(tree.nodes.size()) {
        // Children stand after their parents in most trees, but not in all.
        if (stand_after_parents()) {
            for (std::size_t i = tree.nodes.size(); i-- > 2;) choose(std::uint32_t(i));
            choose(0);
        } else {
            std::vector<std::uint32_t> order;
            tree.for_each_node([&](std::uint32_t node, unsigned) { order.push_back(node); });
            for (std::size_t i = order.size(); i-- > 0;) choose(order[i]);
        }
    }
    const Row& row(std::uint32_t node) const { return rows_[node]; }
    double cost() const { return double{rows_[0].cost[0]}; }

    /// The nodes of the binary tree that become the children of the wide node made of this one, in
    /// the tree's order.
    template <class Visit>
    void for_each_child(std::uint32_t node, const Visit& visit) const {
        if (config_.way == CollapseConfig::Way::greedy)
            for_each_greedy_child(node, visit);
        else
            divide(node, opened_below(node), visit);
    }

  private:
    bool stand_after_parents() const {
        for (std::size_t i = 0; i < tree_.nodes.size(); ++i)
            if (i != 1 && !tree_.nodes[i].is_leaf() && tree_.nodes[i].first <= i) return false;
        return true;
    }

    // [collapse_cost]
    /// From the leaves up. In one place stands a leaf, or a wide node, whose N places its two
    /// children share; in i places stand its two children, in k and i - k of them.
    void choose(std::uint32_t index) {
        const BvhNode<D>& node = tree_.nodes[index];
        Row& row = rows_[index];
        const auto weight = static_cast<float>(chance_(node.box));
        row.references = node.is_leaf()
                             ? node.count
                             : rows_[node.first].references + rows_[node.first + 1].references;
        const float as_leaf = leaf_cost(row.references, weight);
        if (node.is_leaf()) {
            row.cost.fill(as_leaf);
            row.opened.fill(1);
            row.places = 1;
            row.is_leaf = true;
            return;
        }
        const Row &a = rows_[node.first], &b = rows_[node.first + 1];
        row.places = static_cast<std::uint8_t>(std::min(N, a.places + b.places));
        std::array<float, N> open;  // in exactly so many places, or fewer below
        for (std::size_t i = 2; i <= row.places; ++i) {
            open[i - 1] = infinity;
            const std::size_t least = i > b.places ? i - b.places : 1;
            for (std::size_t k = least; k < i && k <= a.places; ++k) {
                const float sum = a.cost[k - 1] + b.cost[i - k - 1];
                if (sum < open[i - 1]) open[i - 1] = sum, row.first[i - 1] = std::uint8_t(k);
            }
        }
        const float as_node =
            static_cast<float>(config_.node_cost) * weight + open[row.places - 1u];
        row.is_leaf = row.references <= config_.max_leaf && as_leaf <= as_node;
        row.cost[0] = row.is_leaf ? as_leaf : as_node;
        row.opened[0] = 1;
        for (std::size_t i = 2; i <= N; ++i) {
            const bool opens = i <= row.places && open[i - 1] < row.cost[i - 2];
            row.cost[i - 1] = opens ? open[i - 1] : row.cost[i - 2];
            row.opened[i - 1] = opens ? std::uint8_t(i) : row.opened[i - 2];
        }
    }
    // [collapse_cost]

    float leaf_cost(std::size_t references, float weight) const {
        const std::size_t blocks = (references + config_.block_size - 1) / config_.block_size;
        return static_cast<float>(config_.block_cost) * weight * static_cast<float>(blocks);
    }
    /// All places that can be used: a wide node is always opened.
    std::size_t opened_below(std::uint32_t node) const { return rows_[node].places; }

    template <class Visit>
    void divide(std::uint32_t node, std::size_t places, const Visit& visit) const {
        const std::uint32_t first = tree_.nodes[node].first;
        const std::size_t of_first = rows_[node].first[places - 1];
        hang(first, of_first, visit);
        hang(first + 1, places - of_first, visit);
    }
    template <class Visit>
    void hang(std::uint32_t node, std::size_t places, const Visit& visit) const {
        const std::size_t used = rows_[node].opened[places - 1];
        if (used == 1)
            visit(node);
        else
            divide(node, used, visit);
    }

    // [collapse_greedy]
    /// Whatever has the largest surface is opened first (Wald, Benthin & Boulos 2008).
    template <class Visit>
    void for_each_greedy_child(std::uint32_t node, const Visit& visit) const {
        std::array<std::uint32_t, N> children{tree_.nodes[node].first, tree_.nodes[node].first + 1};
        std::size_t size = 2;
        while (size < N) {
            std::size_t largest = N;
            for (std::size_t i = 0; i < size; ++i)
                if (!rows_[children[i]].is_leaf &&
                    (largest == N || weight(children[i]) > weight(children[largest])))
                    largest = i;
            if (largest == N) break;
            const std::uint32_t pair = tree_.nodes[children[largest]].first;
            std::copy_backward(children.begin() + largest, children.begin() + size,
                               children.begin() + size + 1);
            children[largest] = pair;
            children[largest + 1] = pair + 1;
            ++size;
        }
        for (std::size_t i = 0; i < size; ++i) visit(children[i]);
    }
    // [collapse_greedy]
    double weight(std::uint32_t node) const { return chance_.weight(tree_.nodes[node].box); }

    const BvhNodes<D>& tree_;
    CollapseConfig config_;
    HitChance<D> chance_;
    std::vector<Row, CacheLineAllocator<Row>> rows_;  ///< the gap's is not written
};

}  // namespace space
