/// @file
/// Exercise 3.7: Inside or outside
/// Difficulty 3 of 3, about 35 minutes.
///
/// The tree holds the edges of closed polygons, whose front sides look outwards. Where does a point
/// lie: Location::inside, outside, or boundary, which is on an edge? Where a node has no child in
/// front, its empty cell touches the fronts of the node's edges; where it has none behind, their
/// backs. A point on a node's line is no boundary point yet: the edges may be elsewhere on that
/// line. Do it without BspTree::locate. Points are whole or half, and `tree.side_of(p, node)` is
/// exact: 1, 0 or -1, as in exercise 3.4. Without nodes all is outside.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"

#include <cstdint>

namespace space {

inline Location where_is(const BspTree<2>& tree, const Point2& p) {
    std::uint32_t index = tree.nodes.empty() ? tree.none : 0;
    bool in_front = true;
    while (index != tree.none) {
        const auto& node = tree.nodes[index];
        in_front = tree.side_of(p, node) >= 0;  // TODO: and on the line?
        index = in_front ? node.front : node.back;
    }
    return in_front ? Location::outside : Location::inside;
}

}  // namespace space
