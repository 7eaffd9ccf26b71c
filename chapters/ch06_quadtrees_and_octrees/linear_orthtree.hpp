/// @file
/// A linear quadtree or octree (Gargantini 1982, "An Effective Way to Represent Quadtrees"): items
/// sorted by their Morton codes, and cells that are ranges of them. The codes of a cell's items
/// begin with the same digits, so its items stand together, child after child.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// What a builder of linear trees may choose.
struct LinearOrthtreeConfig {
    std::size_t leaf_size = 8;     ///< a cell with more items is split
    std::uint32_t max_depth = 31;  ///< but not at this depth, nor at max_orthtree_depth<D>
    /// Whether a node takes the smallest cell that holds its items, in place of a chain of cells
    /// with one child each: fewer than 2 n nodes, however close the items are.
    bool skip_chains = false;
};

/// Cells over sorted codes. Empty cells have no node.
template <int D>
struct LinearOrthtree {
    static constexpr std::uint32_t finest = max_orthtree_depth<D>;

    /// Items first .. last - 1.
    struct Node {
        std::uint32_t first, last;
        std::uint32_t children = 0;  ///< the first of them; the others follow by orthants
        std::uint8_t orthants = 0;   ///< bit k: child k is not empty
        std::uint8_t depth = 0;      ///< of the node's cell

        bool is_leaf() const { return orthants == 0; }
        std::uint32_t size() const { return last - first; }
        bool operator==(const Node&) const = default;
    };
    /// Event: a node has got its children, or none.
    struct Made {
        std::uint32_t node;
        OrthtreeCell<D> cell;
    };

    std::vector<std::uint64_t> codes = {};  ///< of the items, at the finest depth, ascending
    std::vector<Node> nodes = {};           ///< children after parents; the first is the root
    std::uint32_t depth = 0;                ///< of the deepest leaf

    /// @throws LimitError for more than 2^32 - 1 items or nodes
    template <class Observer = NoObserver>
    static LinearOrthtree build(std::vector<std::uint64_t> sorted_codes,
                                const LinearOrthtreeConfig& config = {}, Observer&& observer = {}) {
        constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
        if (sorted_codes.size() > most)
            throw LimitError("linear orthtree: more than 4294967295 items");
        LinearOrthtree tree;
        if (sorted_codes.empty()) return tree;
        tree.codes = std::move(sorted_codes);
        tree.nodes.push_back({0, static_cast<std::uint32_t>(tree.codes.size())});
        for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) {
            tree.split(node, config);
            if (tree.nodes.size() > most)
                throw LimitError("linear orthtree: more than 4294967295 nodes");
            tree.depth = std::max<std::uint32_t>(tree.depth, tree.nodes[node].depth);
            observer.observe(Made{node, tree.cell(tree.nodes[node])});
        }
        return tree;
    }

    bool empty() const { return nodes.empty(); }
    /// The digits that its items' codes begin with.
    OrthtreeCell<D> cell(const Node& node) const {
        return cell_of_code<D>(codes[node.first] >> (D * (finest - node.depth)), node.depth);
    }
    std::span<const Node> children(const Node& node) const {
        return std::span(nodes).subspan(node.children, std::size_t(std::popcount(node.orthants)));
    }
    /// None where that orthant is empty.
    const Node* child(const Node& node, std::uint32_t orthant) const {
        if (!((node.orthants >> orthant) & 1)) return nullptr;
        const std::uint32_t before = node.orthants & ((1u << orthant) - 1);
        return &nodes[node.children + std::uint32_t(std::popcount(before))];
    }

    /// In which child of a cell of this depth a code lies.
    static std::uint32_t orthant_of(std::uint64_t code, std::uint32_t depth) {
        return static_cast<std::uint32_t>(code >> (D * (finest - 1 - depth))) & (orthants<D> - 1);
    }
    /// Of the smallest cell that holds both.
    static std::uint32_t common_depth(std::uint64_t a, std::uint64_t b) {
        return (D * finest - static_cast<std::uint32_t>(std::bit_width(a ^ b))) / D;
    }

  private:
    // [split]
    /// Where one orthant's items end and the next one's begin is found by bisection.
    void split(std::uint32_t index, const LinearOrthtreeConfig& config) {
        Node node = nodes[index];
        if (node.size() <= config.leaf_size) return;
        const std::uint32_t max_depth = std::min(config.max_depth, finest);
        if (config.skip_chains) {
            const std::uint32_t common = common_depth(codes[node.first], codes[node.last - 1]);
            node.depth = static_cast<std::uint8_t>(std::min(common, max_depth));
        }
        if (node.depth < max_depth) {
            node.children = static_cast<std::uint32_t>(nodes.size());
            for (std::uint32_t first = node.first; first < node.last;) {
                const std::uint32_t orthant = orthant_of(codes[first], node.depth);
                const auto end = std::partition_point(
                    codes.begin() + first, codes.begin() + node.last,
                    [&](std::uint64_t code) { return orthant_of(code, node.depth) == orthant; });
                const auto last = static_cast<std::uint32_t>(end - codes.begin());
                node.orthants = static_cast<std::uint8_t>(node.orthants | (1u << orthant));
                nodes.push_back({first, last, 0, 0, static_cast<std::uint8_t>(node.depth + 1)});
                first = last;
            }
        }
        nodes[index] = node;
    }
    // [split]
};

// [boxes_around]
/// For each node the box of what its items fill: extend(box, i) makes a box hold item i. Children
/// come after their parents, so the last is the first to be done.
template <int D, class Extend>
std::vector<BasicAabb<D>> boxes_around(const LinearOrthtree<D>& tree, const Extend& extend) {
    std::vector<BasicAabb<D>> boxes(tree.nodes.size());
    for (std::size_t i = boxes.size(); i-- > 0;) {
        const auto& node = tree.nodes[i];
        const std::size_t children = tree.children(node).size();
        for (std::size_t k = 0; k < children; ++k) boxes[i].extend(boxes[node.children + k]);
        for (std::uint32_t item = node.first; node.is_leaf() && item < node.last; ++item)
            extend(boxes[i], item);
    }
    return boxes;
}
// [boxes_around]

}  // namespace space
