/// @file
/// Exercise 7.4, our answer.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace space {

template <class Enter, class Own>
void nearest_first(const BvhNodes<3>& tree, const Enter& enter, const Own& own) {
    struct Waiting {
        std::uint32_t node;
        float enter;
    };
    std::vector<Waiting> waiting;
    float nearest = infinity;
    const auto wait = [&](const Waiting& child) {
        if (child.enter < infinity && child.enter <= nearest) waiting.push_back(child);
    };
    if (!tree.empty()) wait({0, enter(0)});
    while (!waiting.empty()) {
        const Waiting in_hand = waiting.back();
        waiting.pop_back();
        if (in_hand.enter > nearest) continue;
        const BvhNode<3>& node = tree.nodes[in_hand.node];
        if (node.is_leaf()) {
            nearest = own(in_hand.node);
            continue;
        }
        Waiting near{node.first, enter(node.first)};
        Waiting far{node.first + 1, enter(node.first + 1)};
        if (far.enter < near.enter) std::swap(near, far);
        wait(far);
        wait(near);
    }
}

}  // namespace space
