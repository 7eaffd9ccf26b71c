/// @file
/// Exercise 7.5: Refit after one change
/// Difficulty 2 of 3, about 30 minutes.
///
/// A triangle has moved. The tree may keep its shape if the boxes on the way up are made to fit
/// again: that of the leaf which names it, and those of the nodes above. They are to be the
/// smallest ones, so a box may shrink, too. And no more is to be done than is needed: where a box
/// comes out as it was, nothing above it changes.
///
/// `tree` offers what you need and counts what you do: `box(node)`, `set_box(node, box)`,
/// `parent(node)` (of the root: the root), `first_child(node)`, whose sibling is the next number,
/// and `bounds_of_triangles(leaf)`. Call `set_box` only with a box that is another one, go up by
/// `parent` only from where you did, and ask for the triangles of the leaf once.
#pragma once

#include "common/geometry.hpp"

#include <cstdint>

namespace space {

/// Node 0 is the root, and may be the leaf.
template <class Tree>
void refit_from(Tree& tree, std::uint32_t leaf) {
    // TODO: the leaf fits, but the boxes above may not
    tree.set_box(leaf, tree.bounds_of_triangles(leaf));
}

}  // namespace space
