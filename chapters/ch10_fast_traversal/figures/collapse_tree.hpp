/// @file
/// A binary tree of segments, drawn in the colours of the wide nodes that it is collapsed to.
#pragma once

#include "chapters/ch10_fast_traversal/collapse_choice.hpp"
#include "chapters/ch10_fast_traversal/figures/walls.hpp"
#include "common/program/svg.hpp"

#include <cstdint>
#include <vector>

namespace space::ch10 {

using Choice4 = CollapseChoice<4, 2>;

/// Leaves of one segment; a node and a block of them cost the same.
CollapseConfig one_segment_leaves(CollapseConfig::Way way);

/// A wide node: the nodes of the binary tree that it takes the place of, the first of them on top.
struct Piece {
    std::vector<std::uint32_t> nodes, children;
    double chance;  ///< that a ray through the root meets it
};
/// In the order in which they are made.
std::vector<Piece> pieces_of(const BvhNodes<2>& tree, const Choice4& choice);
/// What a ray through the root is expected to pay, by the pieces' chances and the leaves'.
double cost_of(const BvhNodes<2>& tree, const std::vector<Piece>& pieces);

/// Where the tree stands on the paper.
class CollapseTree {
  public:
    CollapseTree(const Walls<2>& walls, Point2 corner, Vector2 size);

    Point2 place(std::uint32_t node) const;
    void draw_edge(Svg& svg, std::uint32_t node, std::uint32_t child, Ink ink) const;
    /// An inner node, filled where it is on top of a piece; or a leaf.
    void draw_node(Svg& svg, std::uint32_t node, Ink ink, bool filled) const;
    void draw_piece(Svg& svg, const Piece& piece, Ink ink) const;

  private:
    const Walls<2>& walls_;
    Point2 corner_;
    Vector2 size_;
    double levels_ = 1.0, leaves_ = 1.0;
    std::vector<Double2> layout_;
};

}  // namespace space::ch10
