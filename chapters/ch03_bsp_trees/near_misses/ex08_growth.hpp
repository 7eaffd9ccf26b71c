/// @file
/// Exercise 3.8, a near miss: takes each node for a polygon of its own, so that what lies in one
/// plane hides cuts.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace space {

/// What n polygons have become.
struct Growth {
    std::size_t cuts = 0;         ///< how often a piece was cut in two
    std::size_t most_pieces = 0;  ///< of one polygon
    std::size_t levels = 0;       ///< nodes on the longest way down; 1 for a root alone
    double mean_level = 0.0;      ///< of the nodes; the root is on level 1
};

inline Growth growth_of(const BspTree<2>& tree) {
    Growth growth;
    if (tree.nodes.empty()) return growth;
    growth.cuts = tree.nodes.size() - std::min(tree.nodes.size(), tree.polygons.size());
    std::vector<std::size_t> pieces(tree.polygons.size());
    for (const auto& fragment : tree.fragments)
        growth.most_pieces = std::max(growth.most_pieces, ++pieces[fragment.polygon]);

    std::vector<std::size_t> level(tree.nodes.size(), 1);
    double sum = 0.0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        growth.levels = std::max(growth.levels, level[i]);
        sum += static_cast<double>(level[i]);
        for (const std::uint32_t child : {tree.nodes[i].front, tree.nodes[i].back})
            if (child != tree.none) level[child] = level[i] + 1;
    }
    growth.mean_level = sum / static_cast<double>(tree.nodes.size());
    return growth;
}

}  // namespace space
