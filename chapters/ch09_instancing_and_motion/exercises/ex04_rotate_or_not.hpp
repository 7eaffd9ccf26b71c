/// @file
/// Exercise 9.4: Rotate or not?
/// Difficulty 2 of 3, about 30 minutes.
///
/// Triangles have moved, and all boxes of their tree fit again. Below an inner node a child may
/// change places with a child of its sibling, each with all that is below it. What rays pay for
/// inner nodes is in proportion to the sum of their boxes' surfaces. Find the swap that makes this
/// sum smallest, and tell by how much half of it falls.
///
/// `tree.nodes[i]` has `box`, `is_leaf()`, and of an inner node `first`: its children are
/// `tree.nodes[first]` and `tree.nodes[first + 1]`. Of a leaf `first` says something else. A box
/// has `extend(box)`, and `half_area()`, in double. Where no swap makes the sum smaller, the answer
/// is none. Of equal swaps any will do.
///
/// It will be checked against all swaps, made for a trial, with all boxes of the tree made anew.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"

#include <cstdint>
#include <optional>

namespace space {

/// The numbers of two nodes that are to change places, and what that saves.
struct ChildSwap {
    std::uint32_t child = 0, grandchild = 0;
    double saved = 0.0;  ///< of the sum of inner nodes' half areas
};

/// Below an inner node.
inline std::optional<ChildSwap> best_swap(const BvhNodes<3>& /*tree*/, std::uint32_t /*node*/) {
    return {};  // TODO
}

}  // namespace space
