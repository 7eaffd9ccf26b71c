/// @file
/// How much the children of a bounding volume hierarchy overlap. Those of a tree of cells do not.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/program/numbers.hpp"

#include <cstdint>

namespace space::ch12 {

/// Of the random lines that meet an inner node's box, the share that meets what the boxes of both
/// children have in common, 0 to 1: a ratio of surfaces summed over the nodes, as the tree's cost
/// is. A face that the two share is nothing in common.
double child_overlap(const BvhNodes<3>& tree);

/// Of trees by bins, and by bins and spatial splits, over the compared scenes that are made, each
/// in its second size.
void count_child_overlap(std::uint64_t seed, Numbers& numbers);

}  // namespace space::ch12
