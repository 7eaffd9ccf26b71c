/// @file
/// The wide tree: nodes, blocks of triangles, and how deep it is.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "chapters/ch10_fast_traversal/triangle_block.hpp"
#include "chapters/ch10_fast_traversal/wide_node.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace space {

/// A tree whose nodes have up to N children.
template <int N>
struct WideTree {
    static constexpr int width = N;

    std::vector<WideNode<N>, CacheLineAllocator<WideNode<N>>> nodes;
    std::vector<TriangleBlock, CacheLineAllocator<TriangleBlock>> blocks;
    WideChild root;      ///< where there are triangles
    Aabb box;            ///< around all
    unsigned depth = 0;  ///< edges from the root to the deepest leaf
    std::size_t leaves = 0;
    std::size_t references = 0;  ///< triangles in all blocks
    double cost = 0.0;           ///< expected for a ray that meets the box, as the collapse counts

    /// Without triangles, as a tree is that was moved elsewhere.
    bool empty() const { return blocks.empty(); }
    /// What a ray's stack must hold: all children but one of each node on the way down.
    std::size_t stack_size() const { return std::size_t(depth) * (N - 1) + N; }
    /// All that it has written; what is reserved beyond that takes no memory.
    std::size_t bytes() const {
        return nodes.size() * sizeof(WideNode<N>) + blocks.size() * sizeof(TriangleBlock);
    }
    /// Calls own(block) for each block of a leaf until it returns false. @return whether none did
    template <class Own>
    bool each_block(WideChild leaf, const Own& own) const {
        for (std::uint32_t i = leaf.first(); i < leaf.first() + leaf.count(); ++i)
            if (!own(blocks[i])) return false;
        return true;
    }
    /// The largest size of a coordinate.
    float largest() const {
        float most = 0.0f;
        for (int axis = 0; axis < 3 && !empty(); ++axis)
            most = std::max({most, std::abs(box.min[axis]), std::abs(box.max[axis])});
        return most;
    }
};

}  // namespace space
