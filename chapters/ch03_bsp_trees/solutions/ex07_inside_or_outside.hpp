/// @file
/// Exercise 3.7, solution.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"

#include <cstdint>
#include <vector>

namespace space {

inline Location where_is(const BspTree<2>& tree, const Point2& p) {
    bool inside = false, outside = tree.nodes.empty();
    std::vector<std::uint32_t> to_visit;
    if (!tree.nodes.empty()) to_visit.push_back(0);
    while (!to_visit.empty()) {
        const auto& node = tree.nodes[to_visit.back()];
        to_visit.pop_back();
        const int side = tree.side_of(p, node);
        const auto visit = [&](std::uint32_t child, bool& empty_cell) {
            if (child == tree.none)
                empty_cell = true;
            else
                to_visit.push_back(child);
        };
        if (side >= 0) visit(node.front, outside);
        if (side <= 0) visit(node.back, inside);
    }
    return inside && outside ? Location::boundary : inside ? Location::inside : Location::outside;
}

}  // namespace space
