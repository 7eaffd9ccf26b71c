/// @file
/// How a BSP tree of named segments came about: the builder's events, kept in order for drawings
/// and for the step-through page.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "common/program/plane_view.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space::ch03 {

/// The part of a convex cell in front of a line, or behind it.
ConvexCell part_of(const ConvexCell& cell, const SplitPlane<2>& line, bool in_front);

/// A segment or a piece of one; pieces of C are C1 (in front of the line that cut it) and C2.
struct Piece {
    std::string name;
    std::uint32_t polygon;
    Double2 from, to;
};

/// One turn of the builder's loop: a splitter, and where it sends the others. Pieces are numbers in
/// Story::pieces.
struct Turn {
    std::uint32_t parent;
    bool in_front;  ///< of the parent
    std::optional<std::uint32_t> splitter;
    std::vector<std::size_t> set, front, back, own;
    /// A piece that lay across, and what it became.
    struct Cut {
        std::size_t whole, front, back;
    };
    std::vector<Cut> cuts;
    ConvexCell cell;  ///< the part of the frame that the node is about
};

/// An empty part of the plane at the bottom of the tree: a missing child of a node.
struct EmptyCell {
    std::uint32_t node;
    bool in_front;
    ConvexCell cell;
    Double2 place;  ///< for its number: far from its sides and from all pieces; at a corner of a
                    ///< cell that is too thin, at its node's splitter if it has none
};

/// The tree with the turns that made it, one for each node.
struct Story {
    BspTree<2> tree;
    std::vector<Piece> pieces;
    std::vector<Turn> turns;
    std::vector<std::size_t> fragment_pieces;  ///< of the tree's fragments
    std::vector<EmptyCell>
        cells;  ///< from back to front in every node: from left to right in a drawn tree

    /// Of a turn: the piece that lies in its line, the first if there are more.
    const Piece& splitter(std::size_t turn) const { return pieces[turns[turn].own.front()]; }
    /// Whether there are segments without extent.
    bool left_out() const;
};

/// Where the cut was made.
Double2 cut_point(const Story& story, const Turn::Cut& cut);

/// Builds the tree and watches. Segments are called A, B, C ..; `frame` is the part of the plane
/// that is shown.
Story watched_build(std::span<const Segment> segments, const BspConfig& config,
                    const ConvexCell& frame);

/// The segments A .. G of Heinonen16 with the splitters that the thesis chooses.
Story heinonen_story();

/// "C1" as the drawings write it: "*C*_1".
std::string written(const Piece& piece);
/// "{*A*, *B*}"
std::string written(const Story& story, std::span<const std::size_t> set);

/// The nodes, and after them the empty cells, below each node: from left to right in a drawn tree.
std::vector<std::vector<std::size_t>> children_of(const Story& story);

/// Where the nodes and the empty cells of a drawn tree stand: x in slots from the left, one for
/// each empty cell; y in levels.
struct TreeLayout {
    std::vector<Double2> nodes, cells;
    std::size_t levels = 0;  ///< with the cells
};
TreeLayout layout_of(const Story& story);

}  // namespace space::ch03
