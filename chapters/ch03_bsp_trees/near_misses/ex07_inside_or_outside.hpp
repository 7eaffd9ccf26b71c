/// @file
/// Exercise 3.7, a near miss: takes every point on the line of an edge for a point of the edge.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"

#include <cstdint>

namespace space {

inline Location where_is(const BspTree<2>& tree, const Point2& p) {
    std::uint32_t index = tree.nodes.empty() ? tree.none : 0;
    bool in_front = true;
    while (index != tree.none) {
        const auto& node = tree.nodes[index];
        const int side = tree.side_of(p, node);
        if (side == 0) return Location::boundary;
        in_front = side > 0;
        index = in_front ? node.front : node.back;
    }
    return in_front ? Location::outside : Location::inside;
}

}  // namespace space
