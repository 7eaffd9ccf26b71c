/// @file
/// What a quadtree or octree over polygons is. orthtree_builder.hpp makes one.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

// [orthtree_node]
/// A node in twelve bytes. Those of its children that are not empty stand side by side, in the
/// order of their numbers; an empty child is a bit that is not set, and no node.
struct OrthtreeNode {
    std::uint32_t children = 0;    ///< the index of the first
    std::uint32_t first = 0;       ///< of what it names among the references
    std::uint32_t count : 24 = 0;  ///< how many it names
    std::uint32_t mask : 8 = 0;    ///< bit k is set where child k is not empty; none in a leaf

    bool is_leaf() const { return mask == 0; }
    bool has(std::uint32_t k) const { return (mask >> k & 1u) != 0; }
    /// The index of child k, which it has: the ones before it are counted.
    std::uint32_t child(std::uint32_t k) const {
        return children + static_cast<std::uint32_t>(std::popcount(mask & ((1u << k) - 1u)));
    }

    bool operator==(const OrthtreeNode&) const = default;

    static constexpr std::size_t largest_count = (1u << 24) - 1;
};
static_assert(sizeof(OrthtreeNode) == 12);
// [orthtree_node]

/// A cell as its centre and half of its edge: in a tree's own cells both are exact.
template <int D>
struct OrthtreeCube {
    Double<D> centre;
    double half;

    static OrthtreeCube of(const OrthtreeFrame<D>& frame) {
        return {frame.box().centre(), 0.5 * frame.edge};
    }
    OrthtreeCube child(std::uint32_t k) const {
        OrthtreeCube cube{centre, 0.5 * half};
        const double step[2] = {-cube.half, cube.half};
#pragma GCC unroll 3
        for (int axis = 0; axis < D; ++axis) cube.centre[axis] += step[k >> axis & 1u];
        return cube;
    }
    /// The cell as far as it reaches. Builder and walks take it from here: where it is rounded,
    /// both have the same.
    OrthtreeBox<D> box(double looseness = 1.0) const {
        return {centre - looseness * half, centre + looseness * half};
    }
};

/// The tree over polygons that it knows by their indices.
template <int D>
struct OrthtreeNodes {
    OrthtreeFrame<D> frame;                 ///< the root's cell
    BasicAabb<D> bounds;                    ///< of all polygons
    std::vector<OrthtreeNode> nodes;        ///< the root first; none for no polygons
    std::vector<std::uint32_t> references;  ///< polygons, by index
    double looseness = 1.0;                 ///< how far cells reach, in halves of their edges
    std::size_t depth = 0;                  ///< edges from the root to the deepest leaf

    using Handle = std::uint32_t;  ///< what a node is asked for by

    static Handle root() { return 0; }
    bool empty() const { return nodes.empty(); }
    OrthtreeNode node(Handle index) const { return nodes[index]; }

    /// What a leaf names, or an inner node keeps.
    std::span<const std::uint32_t> own(std::uint32_t index) const {
        return std::span(references).subspan(nodes[index].first, nodes[index].count);
    }

    /// Calls visit(index, cell) for each node, the parent first, children in the order of their
    /// numbers.
    template <class Visit>
    void for_each_cell(const Visit& visit) const {
        if (!nodes.empty()) for_each_cell(0, {}, visit);
    }

  private:
    template <class Visit>
    void for_each_cell(std::uint32_t index, const OrthtreeCell<D>& cell, const Visit& visit) const {
        visit(index, cell);
        for (std::uint32_t k = 0; k < orthants<D>; ++k)
            if (nodes[index].has(k)) for_each_cell(nodes[index].child(k), cell.child(k), visit);
    }
};

}  // namespace space
