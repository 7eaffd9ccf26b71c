/// @file
/// A wide tree in less memory: compressed nodes, and triangles that name their corners, each of
/// which is there once.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "chapters/ch10_fast_traversal/compressed_node.hpp"
#include "chapters/ch10_fast_traversal/triangle_block.hpp"
#include "chapters/ch10_fast_traversal/wide_tree.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace space {

// [indexed_triangle]
/// A triangle of a leaf, in 16 bytes. The last one of a leaf says so, so that a child is a word.
struct IndexedTriangle {
    static constexpr std::uint32_t last_bit = 1u << 31;

    std::array<std::uint32_t, 3> corners;
    std::uint32_t word;

    std::uint32_t index() const { return word & ~last_bit; }
    bool is_last() const { return (word & last_bit) != 0; }
};
// [indexed_triangle]
static_assert(sizeof(IndexedTriangle) == 16);

/// Made from a WideTree. A leaf's child word is WideChild::leaf_bit and the number of its first
/// triangle.
struct CompressedTree {
    static constexpr int width = 8;

    std::vector<CompressedNode, CacheLineAllocator<CompressedNode>> nodes;
    std::vector<IndexedTriangle, CacheLineAllocator<IndexedTriangle>> triangles;
    std::vector<Point3> corners;  ///< in the order of their first use
    WideChild root;               ///< where there are triangles
    Aabb box;
    unsigned depth = 0;
    std::size_t leaves = 0;
    double cost = 0.0;  ///< of the tree that it was made from

    bool empty() const { return triangles.empty(); }
    std::size_t stack_size() const { return std::size_t(depth) * 7 + 8; }
    std::size_t bytes() const {
        return nodes.size() * sizeof(CompressedNode) + triangles.size() * sizeof(IndexedTriangle) +
               corners.size() * sizeof(Point3);
    }
    /// The largest size of a coordinate.
    float largest() const {
        float most = 0.0f;
        for (int axis = 0; axis < 3 && !empty(); ++axis)
            most = std::max({most, std::abs(box.min[axis]), std::abs(box.max[axis])});
        return most;
    }
    static std::uint32_t first_of(WideChild leaf) { return leaf.word & ~WideChild::leaf_bit; }

    /// Calls own(block) for the leaf's triangles, four at a time, until it returns false.
    /// @return whether it never did
    template <class Own>
    bool each_block(WideChild leaf, const Own& own) const {
        for (std::uint32_t at = first_of(leaf);;) {
            TriangleBlock block;
            bool is_over = false;
            for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
                if (is_over) {
                    block.clear(lane);
                    continue;
                }
                const IndexedTriangle& triangle = triangles[at++];
                block.put(lane,
                          {corners[triangle.corners[0]], corners[triangle.corners[1]],
                           corners[triangle.corners[2]]},
                          triangle.index());
                is_over = triangle.is_last();
            }
            if (!own(block)) return false;
            if (is_over) return true;
        }
    }
};

/// Compresses one tree.
class TreeCompressor {
  public:
    explicit TreeCompressor(const WideTree<8>& wide) : wide_(wide) {}

    // [compress_tree]
    /// Node by node where it stands; leaves in the order in which nodes name them.
    CompressedTree run() {
        tree_.box = wide_.box;
        tree_.depth = wide_.depth;
        tree_.leaves = wide_.leaves;
        tree_.cost = wide_.cost;
        if (wide_.empty()) return {};
        tree_.nodes.reserve(wide_.nodes.size());
        tree_.triangles.reserve(wide_.references);
        tree_.root = moved(wide_.root);
        for (const WideNode<8>& node : wide_.nodes) {
            CompressedNode small = compressed(node);
            for (std::size_t i = 0; i < small.count; ++i)
                small.children[i] = moved(small.children[i]);
            tree_.nodes.push_back(small);
        }
        tree_.corners.push_back({});  // kernels read a corner with the float behind it
        tree_.corners.shrink_to_fit();
        return std::move(tree_);
    }
    // [compress_tree]

  private:
    /// A corner's bits: 0 and -0 are two corners.
    using Bits = std::array<std::uint32_t, 3>;
    struct Hash {
        std::size_t operator()(const Bits& bits) const {
            std::uint64_t hash = 0;
            for (const std::uint32_t word : bits) {
                hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
                hash ^= hash >> 29;
            }
            return hash;
        }
    };

    /// A leaf's triangles join the others.
    WideChild moved(WideChild child) {
        if (!child.is_leaf()) return child;
        const auto first = static_cast<std::uint32_t>(tree_.triangles.size());
        for (std::uint32_t i = child.first(); i < child.first() + child.count(); ++i) {
            const TriangleBlock& block = wide_.blocks[i];
            for (std::size_t lane = 0; lane < TriangleBlock::size && block.is_used(lane); ++lane) {
                const Triangle triangle = block.triangle(lane);
                tree_.triangles.push_back(
                    {{corner(triangle.a), corner(triangle.b), corner(triangle.c)},
                     block.indices[lane]});
            }
        }
        tree_.triangles.back().word |= IndexedTriangle::last_bit;
        return {WideChild::leaf_bit | first};
    }
    std::uint32_t corner(const Point3& p) {
        const Bits bits{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                        std::bit_cast<std::uint32_t>(p.z)};
        const auto [found, is_new] =
            numbers_.try_emplace(bits, static_cast<std::uint32_t>(tree_.corners.size()));
        if (is_new) tree_.corners.push_back(p);
        return found->second;
    }

    const WideTree<8>& wide_;
    CompressedTree tree_;
    std::unordered_map<Bits, std::uint32_t, Hash> numbers_;
};

}  // namespace space
