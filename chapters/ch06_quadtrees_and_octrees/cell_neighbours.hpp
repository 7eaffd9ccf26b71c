/// @file
/// Neighbours over faces, found from codes (Schrack 1992, "Finding Neighbors of Equal Size in
/// Linear Quadtrees and Octrees in Constant Time"; Samet 1990, chapter 3).
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/linear_orthtree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"

#include <cstdint>
#include <optional>

namespace space {

/// A face of a cell: across which axis, and on which side.
struct CellFace {
    int axis;
    bool upper;

    CellFace opposite() const { return {axis, !upper}; }
    bool operator==(const CellFace&) const = default;
};

// [face_neighbour]
/// The code of the cell of the same size beyond a face; none beyond the root. One is added to, or
/// taken from, the bits of one axis: between them stand those of the others, through which the
/// carry passes where they are all ones, and the borrow where they are all zeros.
template <int D>
constexpr std::optional<std::uint64_t> face_neighbour(std::uint64_t code, std::uint32_t depth,
                                                      CellFace face) {
    const std::uint64_t all = (std::uint64_t{1} << (D * depth)) - 1;
    const std::uint64_t axis = (morton_steps<D>.back().mask << face.axis) & all;
    const std::uint64_t along = code & axis, others = code & ~axis;
    const std::uint64_t one = axis & (~axis + 1);  // its lowest bit
    if (along == (face.upper ? axis : 0)) return std::nullopt;
    return others | ((face.upper ? (code | ~axis) + one : along - one) & axis);
}
// [face_neighbour]

template <int D>
std::optional<OrthtreeCell<D>> face_neighbour(const OrthtreeCell<D>& cell, CellFace face) {
    const auto code = face_neighbour<D>(morton_code(cell), cell.depth, face);
    if (!code) return std::nullopt;
    return cell_of_code<D>(*code, cell.depth);
}

/// A cell of a tree, which is empty where it has no node.
template <int D>
struct OrthtreePlace {
    OrthtreeCell<D> cell;
    const typename LinearOrthtree<D>::Node* node;

    bool is_leaf() const { return !node || node->is_leaf(); }
    bool operator==(const OrthtreePlace&) const = default;
};

/// The leaf that holds the cell, or the cell itself where the tree goes on below it. For trees that
/// skip no chains and are not empty, as are the next two.
template <int D>
OrthtreePlace<D> find_cell(const LinearOrthtree<D>& tree, const OrthtreeCell<D>& cell) {
    const auto* node = &tree.nodes.front();
    while (!node->is_leaf() && node->depth < cell.depth) {
        const OrthtreeCell<D> next = cell.ancestor(node->depth + 1u);
        node = tree.child(*node, next.orthant());
        if (!node) return {next, nullptr};
    }
    return {tree.cell(*node), node};
}

/// Calls visit(leaf) for all leaves at a face within a cell, in the order of their codes.
template <int D, class Visit>
void for_each_leaf_at(const LinearOrthtree<D>& tree, const OrthtreePlace<D>& place, CellFace face,
                      const Visit& visit) {
    if (place.is_leaf()) {
        visit(place);
        return;
    }
    for (std::uint32_t k = 0; k < orthants<D>; ++k)
        if (((k >> face.axis) & 1) == std::uint32_t{face.upper})
            for_each_leaf_at<D>(tree, {place.cell.child(k), tree.child(*place.node, k)}, face,
                                visit);
}

// [leaves_beyond]
/// Calls visit(leaf) for all leaves that share a part of a leaf's face: one of the same size or
/// larger, or as many smaller ones as stand there; none at the root's own faces.
template <int D, class Visit>
void for_each_leaf_beyond(const LinearOrthtree<D>& tree, const OrthtreeCell<D>& leaf, CellFace face,
                          const Visit& visit) {
    if (const auto beyond = face_neighbour<D>(leaf, face))
        for_each_leaf_at<D>(tree, find_cell<D>(tree, *beyond), face.opposite(), visit);
}
// [leaves_beyond]

}  // namespace space
