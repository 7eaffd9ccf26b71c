/// @file
/// The simplest builder: the longest axis, halved by count.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace space {

// [halved]
/// Half of the references to each side, by the axis on which the boxes' middles are spread
/// farthest. Where middles are equal, the polygons' indices decide: there is always a half, and it
/// is the same everywhere.
template <int D>
BvhCut<D> halved(std::span<BvhReference<D>> range) {
    const int axis = box_around_centroids<D>(range).longest_axis();
    const std::size_t half = range.size() / 2;
    const auto key = [axis](const BvhReference<D>& reference) {
        return std::pair(reference.box.centroid()[axis], reference.polygon);
    };
    std::nth_element(range.begin(), range.begin() + static_cast<std::ptrdiff_t>(half), range.end(),
                     [&](const auto& a, const auto& b) { return key(a) < key(b); });
    return cut_after<D>(half, range);
}
// [halved]

/// Limits; costs change no cut.
struct MedianConfig {
    BvhCosts costs = {};  ///< by which the tree's cost is told; the builder asks for none
    std::size_t max_leaf_size = 4;
};

/// Halves until leaves are small enough: never deeper than log2 n, rounded up, whatever is built.
struct MedianBuilder {
    using Config = MedianConfig;

    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        const auto halve = [&](const BvhTask<D>& task) -> std::optional<BvhCut<D>> {
            if (task.range.size() <= std::max<std::size_t>(config.max_leaf_size, 1)) return {};
            return halved<D>(task.range);
        };
        return build_top_down<D>(boxed<D>(polygons), config.max_leaf_size, max_bvh_depth, halve,
                                 observer);
    }
};

}  // namespace space
