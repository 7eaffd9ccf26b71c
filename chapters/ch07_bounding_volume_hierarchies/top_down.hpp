/// @file
/// What all builders from the root down share: a range of references is a leaf, or is cut in two.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace space {

/// A range of references that is to become a node.
template <int D>
struct BvhTask {
    std::uint32_t node;
    unsigned depth;                    ///< edges from the root
    BasicAabb<D> box;                  ///< around all of them
    std::size_t begin;                 ///< of the range, among all references
    std::span<BvhReference<D>> range;  ///< a builder may change their order
};

/// A range in two: how many come first, and the boxes of both parts.
template <int D>
struct BvhCut {
    std::size_t count;
    BasicAabb<D> first, second;
};

/// Event: a node is cut, its range already in order, or is to be a leaf.
template <int D>
struct BvhChosen {
    const BvhTask<D>& task;
    const std::optional<BvhCut<D>>& cut;
};

/// In the order of the polygons: the same whatever sorted or partitioned them before.
template <int D>
void put_in_order(std::span<BvhReference<D>> range) {
    std::sort(range.begin(), range.end(),
              [](const auto& a, const auto& b) { return a.polygon < b.polygon; });
}

/// The range as it stands, cut after `count` references.
template <int D>
BvhCut<D> cut_after(std::size_t count, std::span<BvhReference<D>> range) {
    return {count, box_around<D>(range.first(count)), box_around<D>(range.subspan(count))};
}

/// Where every builder ends, whatever it chooses.
struct BvhLimits {
    std::size_t max_leaf_size;
    unsigned max_depth;
};

// [build_top_down]
/// Makes the nodes of all that is below a task, which is node 0 of `tree`, and names its polygons
/// in `references`, each range in its place. choose(task) gives the cut, having put the range in
/// order, or nothing for a leaf. Both parts of a cut hold at least one reference. Below max_depth
/// no more is asked: ranges are halved by the polygons' indices, which takes at most 32 more
/// levels, down to leaves of max_leaf_size. hand_out(first, second) may leave both parts of a cut
/// to somebody else; then their two nodes are only places.
template <int D, class Choose, class HandOut, class Observer>
void build_below(const BvhTask<D>& root, const BvhLimits& limits, Choose&& choose,
                 HandOut&& hand_out, Observer& observer, BvhNodes<D>& tree,
                 std::span<std::uint32_t> references) {
    tree.nodes.resize(2);
    std::vector<BvhTask<D>> waiting{root};
    while (!waiting.empty()) {
        const BvhTask<D> task = waiting.back();
        waiting.pop_back();
        tree.depth = std::max(tree.depth, task.depth);
        std::optional<BvhCut<D>> cut;
        if (task.depth < limits.max_depth) cut = choose(task);
        if (!cut) put_in_order(task.range);
        if (task.depth >= limits.max_depth &&
            task.range.size() > std::max<std::size_t>(limits.max_leaf_size, 1))
            cut = cut_after<D>(task.range.size() / 2, task.range);
        observer.observe(BvhChosen<D>{task, cut});
        BvhNode<D>& node = tree.nodes[task.node];
        node.box = task.box;
        if (cut) {
            const auto pair = static_cast<std::uint32_t>(tree.nodes.size());
            node.first = pair;
            const BvhTask<D> first{pair, task.depth + 1, cut->first, task.begin,
                                   task.range.first(cut->count)};
            const BvhTask<D> second{pair + 1, task.depth + 1, cut->second, task.begin + cut->count,
                                    task.range.subspan(cut->count)};
            tree.nodes.resize(pair + 2);
            if (!hand_out(first, second)) waiting.insert(waiting.end(), {second, first});
        } else {
            node.first = static_cast<std::uint32_t>(task.begin);
            node.count = static_cast<std::uint32_t>(task.range.size());
            std::ranges::transform(task.range, references.begin() + std::ptrdiff_t(task.begin),
                                   &BvhReference<D>::polygon);
        }
    }
}

/// The tree of all references; nothing is handed out.
template <int D, class Choose, class Observer>
BvhNodes<D> build_top_down(std::vector<BvhReference<D>> references, std::size_t max_leaf_size,
                           unsigned max_depth, Choose&& choose, Observer& observer) {
    BvhNodes<D> tree;
    if (references.empty()) return tree;
    tree.nodes.reserve(references.size());  // and more, where leaves hold less than two
    tree.references.resize(references.size());
    const std::span<BvhReference<D>> all(references);
    build_below<D>(
        {0, 0, box_around<D>(all), 0, all}, {max_leaf_size, max_depth}, choose,
        [](const auto&, const auto&) { return false; }, observer, tree, tree.references);
    tree.nodes.shrink_to_fit();
    return tree;
}
// [build_top_down]

}  // namespace space
