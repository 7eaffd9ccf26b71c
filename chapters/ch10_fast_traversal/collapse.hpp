/// @file
/// From a binary tree to a wide one: its nodes by a CollapseChoice, its leaves in blocks.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch10_fast_traversal/collapse_choice.hpp"
#include "chapters/ch10_fast_traversal/wide_tree.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// Makes one wide tree.
template <int N>
class WideCollapse {
  public:
    WideCollapse(const BvhNodes<3>& binary, std::span<const Triangle> triangles,
                 const CollapseConfig& config)
        : binary_(binary), triangles_(triangles), choice_(binary, config) {}

    // [collapse_pack]
    WideTree<N> run() {
        tree_.box = binary_.nodes[0].box;
        tree_.cost = choice_.cost();
        // More than most trees take; what is never touched takes no memory.
        tree_.blocks.reserve(binary_.references.size() / 2 + 1);
        tree_.nodes.reserve(binary_.references.size() / 8 + 1);
        Placed root = placed(0, 0);
        tree_.root = root.child;
        while (!waiting_.empty()) {
            const Task task = waiting_.back();
            waiting_.pop_back();
            fill(task);
        }
        return std::move(tree_);
    }
    // [collapse_pack]

  private:
    /// A wide node that has its place and is still to be filled: from a node of the binary tree, or
    /// from a range of too many triangles for one leaf.
    struct Task {
        std::uint32_t wide, binary;
        unsigned depth;
        std::vector<std::uint32_t> crowd = {};
    };
    struct Placed {
        WideChild child;
    };

    /// A leaf's blocks at once, an inner node's place.
    Placed placed(std::uint32_t node, unsigned depth) {
        if (!choice_.row(node).is_leaf)
            return {place_node({.wide = 0, .binary = node, .depth = depth})};
        gather(node);
        return {place_leaf(named_, depth)};
    }
    WideChild place_node(Task task) {
        if (tree_.nodes.size() >= WideChild::leaf_bit)
            throw LimitError("wide tree: more than 2147483648 nodes");
        task.wide = std::uint32_t(tree_.nodes.size());
        const WideChild child = WideChild::node(task.wide);
        WideNode<N>& node = tree_.nodes.emplace_back();
        for (std::size_t i = 0; i < N; ++i) node.put(i, Aabb{}, WideChild{});
        waiting_.push_back(std::move(task));
        return child;
    }
    void fill(const Task& task) {
        std::size_t i = 0;
        if (!task.crowd.empty()) return fill_crowd(task);
        std::array<std::uint32_t, N> children;
        choice_.for_each_child(task.binary, [&](std::uint32_t child) { children[i++] = child; });
        const std::size_t size = i;
        for (i = 0; i < size; ++i) {
            const WideChild child = placed(children[i], task.depth + 1).child;
            tree_.nodes[task.wide].put(i, binary_.nodes[children[i]].box, child);
        }
    }

    /// What a node's leaves name, each triangle once, in the order of the triangles.
    void gather(std::uint32_t node) {
        named_.clear();
        gather_below(node);
        std::sort(named_.begin(), named_.end());
        named_.erase(std::unique(named_.begin(), named_.end()), named_.end());
    }
    void gather_below(std::uint32_t node) {
        if (const auto own = binary_.own(node); !own.empty()) {
            named_.insert(named_.end(), own.begin(), own.end());
            return;
        }
        gather_below(binary_.nodes[node].first);
        gather_below(binary_.nodes[node].first + 1);
    }

    static constexpr std::size_t most = WideChild::max_blocks * TriangleBlock::size;

    WideChild place_leaf(std::span<const std::uint32_t> named, unsigned depth) {
        if (named.size() > most)
            return place_node(
                {.wide = 0, .binary = 0, .depth = depth, .crowd = {named.begin(), named.end()}});
        tree_.depth = std::max(tree_.depth, depth);
        ++tree_.leaves;
        tree_.references += named.size();
        const std::size_t first = tree_.blocks.size(),
                          count = (named.size() + TriangleBlock::size - 1) / TriangleBlock::size;
        if (first + count > WideChild::first_mask)
            throw LimitError("wide tree: more than 268435455 blocks of triangles");
        for (std::size_t i = 0; i < count * TriangleBlock::size; ++i) {
            const std::size_t lane = i % TriangleBlock::size;
            if (lane == 0) tree_.blocks.emplace_back();
            if (i < named.size())
                tree_.blocks.back().put(lane, triangles_[named[i]], named[i]);
            else
                tree_.blocks.back().clear(lane);
        }
        return WideChild::leaf(std::uint32_t(first), std::uint32_t(count));
    }
    /// More triangles in one place than a leaf may hold: in N parts.
    void fill_crowd(const Task& task) {
        const std::span<const std::uint32_t> all(task.crowd);
        const std::size_t part = (all.size() + N - 1) / N;
        for (std::size_t i = 0; i * part < all.size(); ++i) {
            const auto named = all.subspan(i * part, std::min(part, all.size() - i * part));
            Aabb box;
            for (const std::uint32_t index : named) box.extend(bounds(triangles_[index]));
            const WideChild child = place_leaf(named, task.depth + 1);
            tree_.nodes[task.wide].put(i, box, child);
        }
    }

    const BvhNodes<3>& binary_;
    std::span<const Triangle> triangles_;
    CollapseChoice<N, 3> choice_;
    WideTree<N> tree_;
    std::vector<Task> waiting_;
    std::vector<std::uint32_t> named_;  ///< kept for its memory
};

/// The wide tree over the same triangles.
template <int N>
WideTree<N> collapsed(const BvhNodes<3>& binary, std::span<const Triangle> triangles,
                      const CollapseConfig& config = {}) {
    if (binary.empty()) return {};
    return WideCollapse<N>(binary, triangles, config).run();
}

}  // namespace space
