/// @file
/// Exercise 10.1: Four from two
/// Difficulty 3 of 3, about 60 minutes.
///
/// A binary tree becomes one whose nodes have up to four children: some of its inner nodes stay,
/// the others vanish, and what was below them hangs on the node above. A ray that comes to a node
/// tests all of its boxes at once, whether there are two or four, so a node that stays costs a ray
/// the chance to come to it: the area of its box, but for a factor. Leaves cost the same in all
/// these trees. Which nodes are to stay so that the sum of their areas is as small as can be?
///
/// The root stays if it is an inner node, and no node may end with more than four children: leaves,
/// or nodes that stay. Where several choices are equally cheap any will do.
///
/// Chapter 10's greedy way opens the child with the largest area until there are four. The check
/// has a tree of eight leaves for which that is not the cheapest. It has one of 131,072 leaves,
/// too: look at each node a few times and no more. Areas are doubles; a float would round their
/// sums.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// Of a binary tree: an inner node, whose two children stand side by side and behind it, or a leaf.
struct BinaryNode {
    double area = 0.0;        ///< of its box
    std::uint32_t first = 0;  ///< of the two children; 0 for a leaf

    bool is_leaf() const { return first == 0; }
};

/// For each node of the tree, of which the first is the root: whether it stays. Leaves do not count
/// as nodes that stay.
inline std::vector<bool> nodes_that_stay(std::span<const BinaryNode> tree) {
    // TODO: here all inner nodes stay, and the tree is as binary as before
    std::vector<bool> stays;
    for (const BinaryNode& node : tree) stays.push_back(!node.is_leaf());
    return stays;
}

}  // namespace space
