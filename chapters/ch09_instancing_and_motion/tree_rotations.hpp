/// @file
/// Two subtrees change places, where that makes boxes smaller (Kensler 2008, "Tree rotations for
/// improving bounding volume hierarchies"): small repairs on the way of a refit (Kopta, Ize,
/// Spjut, Brunvand, Davis & Kensler 2012, "Fast, effective BVH updates for animated scenes").
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace space {

/// Two nodes below a common one, which change places with all that is below them.
struct BvhRotation {
    std::uint32_t one = 0, other = 0;
    double saved = 0.0;  ///< of the weights of the two children's boxes; nothing: do not rotate
};

/// The box around two nodes' boxes.
template <int D>
BasicAabb<D> box_of_both(const BvhNodes<D>& tree, std::uint32_t one, std::uint32_t other) {
    BasicAabb<D> box = tree.nodes[one].box;
    box.extend(tree.nodes[other].box);
    return box;
}

// [best_rotation]
/// The rotation below an inner node that saves most. The same polygons stay below it, so its own
/// box stays; what a child loses and gets changes the child's box. Of six rotations four swap a
/// child with a child of its sibling, two swap grandchildren. (Siblings are i and i ^ 1.)
template <int D>
BvhRotation best_rotation(const BvhNodes<D>& tree, std::uint32_t node) {
    const HitChance<D> chance(tree.nodes[node].box);
    const auto weight = [&](std::uint32_t i) { return chance.weight(tree.nodes[i].box); };
    const auto weight_of_both = [&](std::uint32_t i, std::uint32_t j) {
        return chance.weight(box_of_both(tree, i, j));
    };
    BvhRotation best;
    const auto consider = [&](std::uint32_t one, std::uint32_t other, double saved) {
        if (saved > best.saved) best = {one, other, saved};
    };
    const std::uint32_t first = tree.nodes[node].first, second = first + 1;
    for (const std::uint32_t child : {first, second}) {
        const std::uint32_t sibling = child ^ 1u;
        if (tree.nodes[sibling].is_leaf()) continue;
        const std::uint32_t below = tree.nodes[sibling].first;
        for (const std::uint32_t out : {below, below + 1})
            consider(child, out, weight(sibling) - weight_of_both(child, out ^ 1u));
    }
    if (tree.nodes[first].is_leaf() || tree.nodes[second].is_leaf()) return best;
    const std::uint32_t one = tree.nodes[first].first, below = tree.nodes[second].first;
    for (const std::uint32_t other : {below, below + 1})
        consider(one, other,
                 weight(first) + weight(second) - weight_of_both(other, one ^ 1u) -
                     weight_of_both(one, other ^ 1u));
    return best;
}
// [best_rotation]

// [rotate]
/// Makes the best rotation below an inner node, where one saves anything. Nodes name their children
/// by place, so subtrees move by one swap. Afterwards a node may stand behind its children.
template <int D>
bool rotate_below(BvhNodes<D>& tree, std::uint32_t node) {
    const BvhRotation best = best_rotation(tree, node);
    if (!(best.saved > 0.0)) return false;
    std::swap(tree.nodes[best.one], tree.nodes[best.other]);
    for (const std::uint32_t child : {tree.nodes[node].first, tree.nodes[node].first + 1}) {
        BvhNode<D>& changed = tree.nodes[child];
        if (!changed.is_leaf()) changed.box = box_of_both(tree, changed.first, changed.first + 1);
    }
    return true;
}
// [rotate]

// [parents_first]
/// The same tree with its pairs in the order in which rays walk, and so parents before children.
/// Leaves keep their references.
template <int D>
void put_parents_first(BvhNodes<D>& tree) {
    struct Waiting {
        std::uint32_t place;  ///< of an inner node, where it stands now
        unsigned depth;
    };
    if (tree.empty()) return;
    auto nodes = tree.nodes;
    std::vector<Waiting> waiting;
    std::uint32_t next = 2;
    tree.depth = 0;
    const auto put = [&](std::uint32_t place, const BvhNode<D>& node, unsigned depth) {
        nodes[place] = node;
        tree.depth = std::max(tree.depth, depth);
        if (!node.is_leaf()) waiting.push_back({place, depth});
    };
    put(0, tree.nodes[0], 0);
    while (!waiting.empty()) {
        const auto [place, depth] = waiting.back();
        waiting.pop_back();
        const std::uint32_t pair = std::exchange(nodes[place].first, next);
        next += 2;
        put(nodes[place].first + 1, tree.nodes[pair + 1], depth + 1);
        put(nodes[place].first, tree.nodes[pair], depth + 1);
    }
    tree.nodes.swap(nodes);
}
// [parents_first]

}  // namespace space
