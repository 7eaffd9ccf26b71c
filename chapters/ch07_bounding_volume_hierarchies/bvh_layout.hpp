/// @file
/// From a tree whose pairs stand in any order to the order in which rays walk it, with leaves as
/// large as pays: for builders that begin at the leaves, or change a tree.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// What may be chosen when a tree is laid out.
struct BvhLayoutConfig {
    BvhCosts costs = {};
    std::size_t max_leaf_size = 8;  ///< of leaves that are made of several
    unsigned max_depth = 64;        ///< what would be deeper is halved
};

/// Lays out a tree. Its inner nodes' boxes are around what is below; the gap is its second node.
template <int D>
class BvhLayout {
  public:
    static BvhNodes<D> of(const BvhNodes<D>& tree, const BvhLayoutConfig& config = {}) {
        if (tree.empty()) return {};
        BvhLayout layout(tree, config);
        layout.list();
        layout.merge_leaves();
        layout.write();
        return std::move(layout.laid_out_);
    }

  private:
    /// A node of the tree.
    struct Row {
        std::uint32_t node;
        std::uint32_t size = 1;    ///< rows from this one on, of it and all below it
        std::uint32_t leaves = 1;  ///< that are left of those below
        std::uint32_t references = 0;
        bool is_leaf = true;
        double cost = 0.0;  ///< of all below, times the root's weight
    };
    /// Leaves that are to be below a node: all that are below a row, or just these.
    struct Task {
        std::uint32_t node;
        unsigned depth;
        std::uint32_t row, first, last;
    };
    static constexpr std::uint32_t no_row = ~0u;

    BvhLayout(const BvhNodes<D>& tree, const BvhLayoutConfig& config)
        : tree_(tree), config_(config), chance_(tree.nodes[0].box) {}

    /// Each node, then what is below its first child, then what is below its second.
    void list() {
        rows_.reserve(tree_.size());
        tree_.for_each_node([&](std::uint32_t node, unsigned) { rows_.push_back({node}); });
    }
    const Row& first_below(std::size_t row) const { return rows_[row + 1]; }
    const Row& second_below(std::size_t row) const {
        return rows_[row + 1 + first_below(row).size];
    }

    // [merge_leaves]
    /// From the last row to the first, so children before their parents: a node becomes a leaf
    /// where that costs no more than all that is below it.
    void merge_leaves() {
        for (std::size_t i = rows_.size(); i-- > 0;) {
            Row& row = rows_[i];
            const BvhNode<D>& node = tree_.nodes[row.node];
            const double weight = chance_.weight(node.box);
            if (node.is_leaf()) {
                row.references = node.count;
                row.cost = config_.costs.intersection * weight * node.count;
                continue;
            }
            const Row &one = first_below(i), &other = second_below(i);
            row.size = 1 + one.size + other.size;
            row.references = one.references + other.references;
            const double as_leaf = config_.costs.intersection * weight * row.references;
            const double as_node = config_.costs.traversal * weight + one.cost + other.cost;
            row.is_leaf = row.references <= config_.max_leaf_size && as_leaf <= as_node;
            row.leaves = row.is_leaf ? 1 : one.leaves + other.leaves;
            row.cost = row.is_leaf ? as_leaf : as_node;
        }
    }
    // [merge_leaves]

    // [write]
    /// In the order of the rows. Where a child's leaves could not all be reached within max_depth,
    /// though it were halved from there on, the node's leaves are halved instead.
    void write() {
        for (std::uint32_t row = 0; row < rows_.size();
             row += rows_[row].is_leaf ? rows_[row].size : 1)
            if (rows_[row].is_leaf) leaves_.push_back(row);
        laid_out_.nodes.resize(2);
        std::vector<Task> waiting{{0, 0, 0, 0, static_cast<std::uint32_t>(leaves_.size())}};
        while (!waiting.empty()) {
            const Task task = waiting.back();
            waiting.pop_back();
            laid_out_.depth = std::max(laid_out_.depth, task.depth);
            if (task.last - task.first == 1 || task.depth == config_.max_depth) {
                write_leaf(task);
                continue;
            }
            const auto pair = static_cast<std::uint32_t>(laid_out_.nodes.size());
            laid_out_.nodes[task.node].first = pair;
            laid_out_.nodes.resize(pair + 2);
            const auto [one, other] = children(task, pair);
            waiting.push_back(other);
            waiting.push_back(one);
        }
        unite_boxes(laid_out_);
    }
    // [write]

    std::pair<Task, Task> children(const Task& task, std::uint32_t pair) const {
        const unsigned depth = task.depth + 1;
        std::uint32_t one = no_row, other = no_row;
        std::uint32_t middle = task.first + (task.last - task.first + 1) / 2;
        if (task.row != no_row) {
            const Row &below_one = first_below(task.row), &below_other = second_below(task.row);
            if (fits(depth, below_one.leaves) && fits(depth, below_other.leaves)) {
                one = task.row + 1;
                other = one + below_one.size;
                middle = task.first + below_one.leaves;
            }
        }
        return {{pair, depth, one, task.first, middle},
                {pair + 1, depth, other, middle, task.last}};
    }
    bool fits(unsigned depth, std::uint32_t leaves) const {
        return depth + static_cast<unsigned>(std::bit_width(leaves - 1)) <= config_.max_depth;
    }

    /// What the leaves name, each polygon once, in the order of the polygons.
    void write_leaf(const Task& task) {
        auto& references = laid_out_.references;
        BvhNode<D>& leaf = laid_out_.nodes[task.node];
        leaf.first = static_cast<std::uint32_t>(references.size());
        for (std::uint32_t i = task.first; i < task.last; ++i) {
            const std::uint32_t row = leaves_[i];
            leaf.box.extend(tree_.nodes[rows_[row].node].box);
            for (const Row& below : std::span(rows_).subspan(row, rows_[row].size))
                for (const std::uint32_t polygon : tree_.own(below.node))
                    references.push_back(polygon);
        }
        const auto begin = references.begin() + leaf.first;
        std::sort(begin, references.end());
        references.erase(std::unique(begin, references.end()), references.end());
        leaf.count = static_cast<std::uint32_t>(references.size()) - leaf.first;
    }

    const BvhNodes<D>& tree_;
    BvhLayoutConfig config_;
    HitChance<D> chance_;
    std::vector<Row> rows_;
    std::vector<std::uint32_t> leaves_;  ///< the rows that are to be leaves
    BvhNodes<D> laid_out_;
};

}  // namespace space
