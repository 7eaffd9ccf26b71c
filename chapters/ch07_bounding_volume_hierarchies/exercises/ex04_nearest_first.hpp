/// @file
/// Exercise 7.4: The nearer child first
/// Difficulty 3 of 3, about 45 minutes.
///
/// Walk a ray through a tree of boxes. `enter(node)` says at which t the ray enters a node's box,
/// and infinity if it misses it. `own(leaf)` tests the triangles of a leaf and returns the t of the
/// nearest hit so far, infinity while there is none. The stub visits everything that the ray meets;
/// yours is to leave out what cannot matter.
///
/// Of two children the ray comes to the nearer one first, the one that it enters earlier; where it
/// enters both at one t, to the first one. All that is below the nearer child comes before the
/// farther one. A box that the ray enters beyond the nearest hit is passed over, also one that
/// waits since before that hit was found. But one that it enters *at* the hit is not: another hit
/// at the same t may be in it, and of equal hits the triangle with the smaller index counts.
///
/// Ask for each box once, when you come to its parent (for the root's at the beginning), and for
/// both children's. A tree may be a chain of 1000 levels, so do it without recursion.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"

#include <cstdint>
#include <vector>

namespace space {

template <class Enter, class Own>
void nearest_first(const BvhNodes<3>& tree, const Enter& enter, const Own& own) {
    // TODO: the nearer child first, and nothing beyond the nearest hit
    if (tree.empty()) return;
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty()) {
        const std::uint32_t index = waiting.back();
        waiting.pop_back();
        const BvhNode<3>& node = tree.nodes[index];
        if (enter(index) == infinity) continue;
        if (node.is_leaf()) {
            own(index);
        } else {
            waiting.push_back(node.first + 1);
            waiting.push_back(node.first);
        }
    }
}

}  // namespace space
