/// @file
/// Exercise 9.4, our answer.
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
inline std::optional<ChildSwap> best_swap(const BvhNodes<3>& tree, std::uint32_t node) {
    std::optional<ChildSwap> best;
    const std::uint32_t first = tree.nodes[node].first;
    for (const std::uint32_t child : {first, first + 1}) {
        const BvhNode<3>& sibling = tree.nodes[2 * first + 1 - child];
        if (sibling.is_leaf()) continue;
        for (const std::uint32_t out : {sibling.first, sibling.first + 1}) {
            Aabb box = tree.nodes[child].box;
            box.extend(tree.nodes[2 * sibling.first + 1 - out].box);  // the one that stays
            const double saved = sibling.box.half_area() - box.half_area();
            if (saved > (best ? best->saved : 0.0)) best = {child, out, saved};
        }
    }
    return best;
}

}  // namespace space
