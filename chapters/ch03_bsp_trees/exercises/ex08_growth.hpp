/// @file
/// Exercise 3.8: What a tree has grown to
/// Difficulty 2 of 3, about 25 minutes.
///
/// A BSP tree costs more than its polygons: cuts make more of them, and a bad order makes it deep.
/// Compute what `Growth` asks for from a tree that was made by cutting. Every polygon of the tree
/// has at least one fragment, and `fragment.polygon` tells whose it is; several fragments may lie
/// in one node. A node stands before its children in `tree.nodes`, so that one pass will do, for a
/// tree of 400,000 levels as well. Do it without BspTree::depth. For no nodes all numbers are 0.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"

#include <cstdint>

namespace space {

/// What n polygons have become.
struct Growth {
    std::size_t cuts = 0;         ///< how often a piece was cut in two
    std::size_t most_pieces = 0;  ///< of one polygon
    std::size_t levels = 0;       ///< nodes on the longest way down; 1 for a root alone
    double mean_level = 0.0;      ///< of the nodes; the root is on level 1
};

inline Growth growth_of(const BspTree<2>& tree) {
    // TODO: this is what it would be if nothing were cut and the tree were a chain
    Growth growth;
    growth.most_pieces = 1;
    growth.levels = tree.nodes.size();
    growth.mean_level = static_cast<double>(tree.nodes.size() + 1) / 2.0;
    return growth;
}

}  // namespace space
