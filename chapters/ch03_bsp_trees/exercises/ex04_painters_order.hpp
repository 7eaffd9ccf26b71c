/// @file
/// Exercise 3.4: Painter's order
/// Difficulty 2 of 3, about 30 minutes.
///
/// Return the numbers of all fragments of a BSP tree, each once, from the farthest to the nearest
/// as seen from the eye: seen from it, what lies beyond a node's plane can't cover what lies in the
/// plane, nor that what lies on the eye's own side. Where the eye is on the plane, either side may
/// come first, but none may be left out. Do it without BspTree::back_to_front, and without
/// recursion: the checks' deepest tree has 400,000 levels. They look at every node of trees over
/// random segments, from eyes on all sides, and count the nodes whose fragments come in a wrong
/// order.
///
/// `tree.nodes[0]` is the root, if there are nodes at all. `node.front` and `node.back` are the
/// indices of its children, or `tree.none`; its own fragments have the numbers `node.first` to
/// `node.first + node.count - 1`; `tree.side_of(eye, node)` is 1, 0 or -1: the eye is in front, on
/// the plane, behind.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"

#include <cstdint>
#include <vector>

namespace space {

inline std::vector<std::uint32_t> painters_order(const BspTree<2>& tree, const Point2& eye) {
    // TODO: this is the order in which the tree was built, whoever looks at it
    static_cast<void>(eye);
    std::vector<std::uint32_t> order;
    for (const auto& node : tree.nodes)
        for (std::uint32_t i = 0; i < node.count; ++i) order.push_back(node.first + i);
    return order;
}

}  // namespace space
