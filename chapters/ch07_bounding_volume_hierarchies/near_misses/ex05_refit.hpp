/// @file
/// Exercise 7.5, a near miss: each box on the way up is extended by the leaf's. Nothing is lost,
/// and pictures are right, but boxes only grow: after some minutes of an animation every ray meets
/// them all.
#pragma once

#include "common/geometry.hpp"

#include <cstdint>

namespace space {

/// Node 0 is the root, and may be the leaf.
template <class Tree>
void refit_from(Tree& tree, std::uint32_t leaf) {
    const Aabb moved = tree.bounds_of_triangles(leaf);
    Aabb box = moved;
    for (std::uint32_t node = leaf; !(box == tree.box(node));) {
        tree.set_box(node, box);
        if (node == 0) return;
        node = tree.parent(node);
        box = tree.box(node);
        box.extend(moved);
    }
}

}  // namespace space
