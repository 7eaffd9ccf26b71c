/// @file
/// Over a BSP tree (Heinonen16, section 3.2): chapter 3's tree gives what belongs together, and
/// boxes are put around it from the leaves up.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "chapters/ch03_bsp_trees/bsp_config.hpp"
#include "chapters/ch03_bsp_trees/bsp_tree.hpp"
#include "chapters/ch04_kd_trees/clipped_bounds.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_layout.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// The box of a fragment. Its corners are the exact ones but for `error`, and all of it lies in the
/// box of its polygon, too.
template <int D>
BasicAabb<D> fragment_box(const Fragment<D>& fragment, const BasicAabb<D>& whole) {
    BasicAabb<D> box;
    for (const auto& corner : fragment.corners)
        for (int axis = 0; axis < D; ++axis) {
            const float low = float_below(corner.at[axis] - corner.error);
            const float high = float_above(corner.at[axis] + corner.error);
            box.min[axis] = std::min(box.min[axis], low);
            box.max[axis] = std::max(box.max[axis], high);
        }
    return {glm::max(box.min, whole.min), glm::min(box.max, whole.max)};
}

/// The boxes around a BSP tree's fragments and subtrees. A polygon that was cut is named once for
/// each fragment, with the fragment's box.
template <int D>
class OverBsp {
  public:
    /// `whole` are the boxes of the tree's polygons, and what these are to be called.
    OverBsp(const BspTree<D>& bsp, std::span<const BvhReference<D>> whole)
        : bsp_(bsp), whole_(whole) {}

    // [over_bsp]
    /// From the last node to the first: children come after their parents. A node's box is around
    /// those of what lies in its plane, in front of it and behind it.
    BvhNodes<D> run() && {
        if (bsp_.nodes.empty()) return {};
        tree_.nodes.resize(2);
        std::vector<BvhNode<D>> tops(bsp_.nodes.size());
        for (std::size_t i = tops.size(); i-- > 0;) {
            const auto& node = bsp_.nodes[i];
            std::vector<BvhNode<D>> parts;
            if (node.count > 0) parts.push_back(in_plane(node));
            if (node.front != BspTree<D>::none) parts.push_back(tops[node.front]);
            if (node.back != BspTree<D>::none) parts.push_back(tops[node.back]);
            tops[i] = joined(std::move(parts));
        }
        tree_.nodes[0] = tops[0];
        return std::move(tree_);
    }
    // [over_bsp]

  private:
    /// One to three in one: of three those two first whose common box is the smallest.
    BvhNode<D> joined(std::vector<BvhNode<D>> parts) {
        if (parts.size() == 3) {
            const HitChance<D> chance(around(around(parts[0].box, parts[1].box), parts[2].box));
            const auto without = [&](std::size_t i) {
                return chance.weight(around(parts[(i + 1) % 3].box, parts[(i + 2) % 3].box));
            };
            std::size_t alone = 2;
            for (const std::size_t i : {0u, 1u})
                if (without(i) < without(alone)) alone = i;
            std::swap(parts[alone], parts[2]);
        }
        BvhNode<D> top = parts[0];
        for (std::size_t i = 1; i < parts.size(); ++i) {
            const auto pair = static_cast<std::uint32_t>(tree_.nodes.size());
            tree_.nodes.push_back(top);
            tree_.nodes.push_back(parts[i]);
            top = {around(top.box, parts[i].box), pair, 0};
        }
        return top;
    }
    static BasicAabb<D> around(BasicAabb<D> box, const BasicAabb<D>& other) {
        box.extend(other);
        return box;
    }

    /// A tree of its own, halved by count, where several lie in one plane.
    BvhNode<D> in_plane(const typename BspTree<D>::Node& node) {
        std::vector<BvhReference<D>> parts;
        for (const auto& fragment : std::span(bsp_.fragments).subspan(node.first, node.count)) {
            const BvhReference<D>& whole = whole_[fragment.polygon];
            parts.push_back({fragment_box(fragment, whole.box), whole.polygon});
        }
        const auto halve = [](const BvhTask<D>& task) -> std::optional<BvhCut<D>> {
            if (task.range.size() == 1) return {};
            return halved<D>(task.range);
        };
        NoObserver none;
        return grafted(build_top_down<D>(std::move(parts), 1, max_bvh_depth, halve, none));
    }
    /// All of a tree below its root; what is to stand for the root.
    BvhNode<D> grafted(const BvhNodes<D>& subtree) {
        const auto pairs = static_cast<std::uint32_t>(tree_.nodes.size() - 2),
                   references = static_cast<std::uint32_t>(tree_.references.size());
        const auto moved = [&](BvhNode<D> node) {
            node.first += node.is_leaf() ? references : pairs;
            return node;
        };
        for (std::size_t i = 2; i < subtree.nodes.size(); ++i)
            tree_.nodes.push_back(moved(subtree.nodes[i]));
        tree_.references.insert(tree_.references.end(), subtree.references.begin(),
                                subtree.references.end());
        return moved(subtree.nodes[0]);
    }

    const BspTree<D>& bsp_;
    std::span<const BvhReference<D>> whole_;
    BvhNodes<D> tree_;
};

/// Costs, and how the BSP tree is built.
struct OverBspConfig {
    BvhCosts costs = {};
    std::size_t max_leaf_size = 8;  ///< nodes are merged into leaves where that pays
    /// Its max_fragments bounds the references. Sides are decided exactly whatever its grade:
    /// only then do a polygon's fragments cover it.
    BspConfig bsp = {};
};

/// The builder. Polygons without extent are in no BSP tree, and so not in this one: no ray hits
/// them.
struct OverBspBuilder {
    using Config = OverBspConfig;

    /// @throws LimitError where the BSP tree outgrows the limits of config.bsp
    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        const std::vector<BvhReference<D>> whole = boxed<D>(polygons);
        std::vector<Simplex<D>> finite;
        for (const BvhReference<D>& reference : whole)
            finite.push_back(polygons[reference.polygon]);
        BspConfig exact = config.bsp;
        exact.grade = Grade::exact;
        const BspTree<D> bsp = BspBuilder<D>::build(finite, exact, observer);
        return BvhLayout<D>::of(OverBsp<D>(bsp, whole).run(), {config.costs, config.max_leaf_size});
    }
};

}  // namespace space
