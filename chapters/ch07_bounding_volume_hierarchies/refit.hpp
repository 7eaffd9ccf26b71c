/// @file
/// Boxes from the leaves up: of a tree whose polygons have moved, or whose leaves alone have boxes.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace space {

// [unite_boxes]
/// Inner nodes' boxes, from the last node to the first: children stand behind their parents.
template <int D>
void unite_boxes(BvhNodes<D>& tree) {
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        BvhNode<D>& node = tree.nodes[i];
        if (i == 1 || node.is_leaf()) continue;  // the gap is no node
        node.box = tree.nodes[node.first].box;
        node.box.extend(tree.nodes[node.first + 1].box);
    }
}
// [unite_boxes]

// [refit]
/// The same tree around the same polygons elsewhere. It stays right, and gets slower the farther
/// they move from those that were neighbours. A polygon that is no longer finite is in no box; one
/// that was not when the tree was built is not in it.
template <int D>
void refit(BvhNodes<D>& tree, std::span<const Simplex<D>> moved) {
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        if (!tree.nodes[i].is_leaf()) continue;
        BasicAabb<D> box;
        for (const std::uint32_t polygon : tree.own(i))
            box.extend(box_if_finite<D>(moved[polygon]));
        tree.nodes[i].box = box;
    }
    unite_boxes(tree);
}
// [refit]

}  // namespace space
