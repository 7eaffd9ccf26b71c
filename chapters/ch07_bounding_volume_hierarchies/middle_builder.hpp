/// @file
/// The builder that cuts space in the middle.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

namespace space {

/// Limits; costs change no cut.
struct MiddleConfig {
    BvhCosts costs = {};  ///< by which the tree's cost is told; the builder asks for none
    std::size_t max_leaf_size = 4;
    unsigned max_depth = 64;  ///< beyond it ranges are halved
};

/// A plane in the middle of the box around the boxes' middles, across its longest axis; each
/// reference goes to the side of its own middle. Where all are on one side, half of them to each.
struct MiddleBuilder {
    using Config = MiddleConfig;

    // [middle_build]
    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        const auto cut = [&](const BvhTask<D>& task) -> std::optional<BvhCut<D>> {
            if (task.range.size() <= std::max<std::size_t>(config.max_leaf_size, 1)) return {};
            const BasicAabb<D> middles = box_around_centroids<D>(task.range);
            const int axis = middles.longest_axis();
            const float plane = middles.centroid()[axis];
            const auto second = std::partition(
                task.range.begin(), task.range.end(),
                [&](const auto& reference) { return reference.box.centroid()[axis] < plane; });
            const auto count = static_cast<std::size_t>(second - task.range.begin());
            if (count == 0 || count == task.range.size()) return halved<D>(task.range);
            return cut_after<D>(count, task.range);
        };
        return build_top_down<D>(boxed<D>(polygons), config.max_leaf_size, config.max_depth, cut,
                                 observer);
    }
    // [middle_build]
};

}  // namespace space
