/// @file
/// Exercise 3.4, a near miss: deals with an eye in front and an eye behind, and forgets that it
/// may be on the plane: everything below that node is lost.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"

#include <cstdint>
#include <vector>

namespace space {

inline std::vector<std::uint32_t> painters_order(const BspTree<2>& tree, const Point2& eye) {
    struct Task {
        std::uint32_t node;
        bool own;
    };
    std::vector<std::uint32_t> order;
    std::vector<Task> tasks{{tree.nodes.empty() ? tree.none : 0, false}};
    while (!tasks.empty()) {
        const auto [index, own] = tasks.back();
        tasks.pop_back();
        if (index == tree.none) continue;
        const auto& node = tree.nodes[index];
        if (own) {
            for (std::uint32_t i = 0; i < node.count; ++i) order.push_back(node.first + i);
            continue;
        }
        const int side = tree.side_of(eye, node);
        if (side == 0) continue;
        const bool in_front = side > 0;
        tasks.push_back({in_front ? node.front : node.back, false});
        tasks.push_back({index, true});
        tasks.push_back({in_front ? node.back : node.front, false});
    }
    return order;
}

}  // namespace space
