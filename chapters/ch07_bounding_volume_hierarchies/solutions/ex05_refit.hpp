/// @file
/// Exercise 7.5, our answer.
#pragma once

#include "common/geometry.hpp"

#include <cstdint>

namespace space {

/// Node 0 is the root, and may be the leaf.
template <class Tree>
void refit_from(Tree& tree, std::uint32_t leaf) {
    Aabb box = tree.bounds_of_triangles(leaf);
    for (std::uint32_t node = leaf; !(box == tree.box(node));) {
        tree.set_box(node, box);
        if (node == 0) return;
        node = tree.parent(node);
        box = tree.box(tree.first_child(node));
        box.extend(tree.box(tree.first_child(node) + 1));
    }
}

}  // namespace space
