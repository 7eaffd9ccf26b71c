/// @file
/// What is wrong with a wide tree, in words.
#pragma once

#include "chapters/ch10_fast_traversal/compressed_tree.hpp"
#include "chapters/ch10_fast_traversal/wide_tree.hpp"
#include "common/geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// In how many leaves a triangle may be.
enum class Named {
    once,     ///< in one alone
    in_parts  ///< in several, as spatial splits put it; their boxes hold what they cut from it
};

/// How often leaves name each triangle, leaf after leaf.
class Names {
  public:
    explicit Names(std::size_t triangles) : times_(triangles), leaf_(triangles, nowhere) {}

    /// @return false where this leaf has named it before
    bool add(std::uint32_t triangle, std::size_t leaf) {
        ++times_[triangle];
        return std::exchange(leaf_[triangle], leaf) != leaf;
    }
    /// What is wrong when all leaves have named theirs: each finite triangle must be in some leaf.
    std::string faults(std::span<const Triangle> triangles, Named how) const {
        for (std::size_t i = 0; i < times_.size(); ++i) {
            const bool is_whole = !box_if_finite<3>(triangles[i]).is_empty();
            if ((times_[i] > 0) != is_whole || (times_[i] > 1 && how == Named::once))
                return fmt::format("triangle {}: in {} leaves", i, times_[i]);
        }
        return "";
    }

  private:
    static constexpr auto nowhere = ~std::size_t{0};

    std::vector<std::size_t> times_, leaf_;
};

/// Empty for a whole tree: each finite triangle in a leaf, in none of them twice, and as it was
/// given; boxes around all that is below; empty places that nothing meets; depth, leaves,
/// references and the stack's size as they are counted.
template <int N>
std::string wide_faults(const WideTree<N>& tree, std::span<const Triangle> triangles,
                        Named how = Named::once) {
    struct Waiting {
        WideChild child;
        Aabb box;
        unsigned depth;
    };
    const auto is_whole = [&](const Triangle& t) { return !box_if_finite<3>(t).is_empty(); };
    if (tree.empty())
        return std::ranges::any_of(triangles, is_whole) ? "an empty tree over triangles" : "";
    std::vector<unsigned> node_used(tree.nodes.size()), block_used(tree.blocks.size());
    Names names(triangles.size());
    std::vector<Waiting> waiting{{tree.root, tree.box, 0}};
    unsigned depth = 0;
    std::size_t leaves = 0, references = 0;
    while (!waiting.empty()) {
        const auto [child, box, level] = waiting.back();
        waiting.pop_back();
        depth = std::max(depth, level);
        if (!child.is_leaf()) {
            if (child.index() >= tree.nodes.size()) return "a child that is no node";
            if (node_used[child.index()]++ != 0) return "a node with two parents";
            const WideNode<N>& node = tree.nodes[child.index()];
            std::size_t used = 0;
            for (std::size_t i = 0; i < N; ++i) {
                const Aabb of_child = node.box(i);
                if (!node.is_used(i)) {
                    for (int axis = 0; axis < 3; ++axis)
                        if (of_child.min[axis] != infinity || of_child.max[axis] != -infinity)
                            return fmt::format("node {}: place {} is empty and can be met",
                                               child.index(), i);
                    continue;
                }
                ++used;
                if (!box.contains(of_child))
                    return fmt::format("node {}: child {} exceeds it", child.index(), i);
                waiting.push_back({node.children[i], of_child, level + 1});
            }
            if (used < 2) return fmt::format("node {}: {} children", child.index(), used);
            continue;
        }
        ++leaves;
        for (std::uint32_t b = child.first(); b < child.first() + child.count(); ++b) {
            if (b >= tree.blocks.size()) return "a leaf beyond the blocks";
            if (block_used[b]++ != 0) return "a block in two leaves";
            const TriangleBlock& block = tree.blocks[b];
            bool ended = false;
            for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
                if (!block.is_used(lane)) {
                    ended = true;
                    if (!std::isnan(block.triangle(lane).a.x)) return "an empty lane with a corner";
                    continue;
                }
                if (ended) return "a triangle after an empty lane";
                const std::uint32_t index = block.indices[lane];
                if (index >= triangles.size()) return "a triangle that is none";
                if (!(block.triangle(lane) == triangles[index]))
                    return fmt::format("triangle {} has changed", index);
                if (how == Named::once && !box.contains(bounds(triangles[index])))
                    return fmt::format("triangle {} exceeds its leaf", index);
                ++references;
                if (!names.add(index, leaves))
                    return fmt::format("triangle {}: twice in one leaf", index);
            }
            if (!block.is_used(0)) return "a block of nothing";
        }
    }
    if (const std::string fault = names.faults(triangles, how); !fault.empty()) return fault;
    if (depth != tree.depth) return fmt::format("depth {}, not {}", tree.depth, depth);
    if (leaves != tree.leaves) return fmt::format("{} leaves, not {}", tree.leaves, leaves);
    if (references != tree.references) return "another number of references";
    if (std::ranges::count(node_used, 0u) != 0) return "a node without a parent";
    if (std::ranges::count(block_used, 0u) != 0) return "a block without a leaf";
    return tree.stack_size() < std::size_t(depth) * (N - 1) + 1 ? "too small a stack" : "";
}

/// The same of a compressed tree, but for boxes: those of children may exceed their parent's. (That
/// none is smaller than it was has a test of its own.)
inline std::string wide_faults(const CompressedTree& tree, std::span<const Triangle> triangles,
                               Named how = Named::once) {
    struct Waiting {
        WideChild child;
        unsigned depth;
    };
    const auto is_whole = [&](const Triangle& t) { return !box_if_finite<3>(t).is_empty(); };
    if (tree.empty())
        return std::ranges::any_of(triangles, is_whole) ? "an empty tree over triangles" : "";
    std::vector<unsigned> node_used(tree.nodes.size());
    Names names(triangles.size());
    std::vector<Waiting> waiting{{tree.root, 0}};
    unsigned depth = 0;
    std::size_t leaves = 0, references = 0;
    std::string fault;
    while (!waiting.empty() && fault.empty()) {
        const auto [child, level] = waiting.back();
        waiting.pop_back();
        depth = std::max(depth, level);
        if (!child.is_leaf()) {
            if (child.index() >= tree.nodes.size()) return "a child that is no node";
            if (node_used[child.index()]++ != 0) return "a node with two parents";
            const CompressedNode& node = tree.nodes[child.index()];
            if (node.count < 2)
                return fmt::format("node {}: {} children", child.index(), node.count);
            for (std::size_t i = 0; i < node.count; ++i)
                waiting.push_back({node.children[i], level + 1});
            continue;
        }
        ++leaves;
        tree.each_block(child, [&](const TriangleBlock& block) {
            for (std::size_t lane = 0; lane < TriangleBlock::size && block.is_used(lane); ++lane) {
                const std::uint32_t index = block.indices[lane];
                if (index >= triangles.size())
                    fault = "a triangle that is none";
                else if (!(block.triangle(lane) == triangles[index]))
                    fault = fmt::format("triangle {} has changed", index);
                else if (!names.add(index, leaves))
                    fault = fmt::format("triangle {}: twice in one leaf", index);
                ++references;
            }
            return fault.empty();
        });
    }
    if (!fault.empty()) return fault;
    if (fault = names.faults(triangles, how); !fault.empty()) return fault;
    if (depth != tree.depth) return fmt::format("depth {}, not {}", tree.depth, depth);
    if (leaves != tree.leaves) return fmt::format("{} leaves, not {}", tree.leaves, leaves);
    if (references != tree.triangles.size()) return "triangles in no leaf";
    if (std::ranges::count(node_used, 0u) != 0) return "a node without a parent";
    return tree.stack_size() < std::size_t(depth) * 7 + 1 ? "too small a stack" : "";
}

}  // namespace space
