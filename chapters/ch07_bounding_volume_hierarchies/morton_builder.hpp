/// @file
/// A linear BVH (Lauterbach et al. 2009, "Fast BVH Construction on GPUs"): polygons in the order of
/// the Morton codes of their middles, cut where the codes' highest bits change. The build is a
/// sort.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/morton_order.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

// [common_prefix]
/// How many bits two keys in sorted order have in common from the highest on (Karras 2012,
/// "Maximizing Parallelism in the Construction of BVHs, Octrees, and k-d Trees", section 4). A key
/// is a code with its own place in the order behind it: so all keys differ, also where codes don't.
struct MortonKeys {
    std::span<const std::uint64_t> codes;  ///< ascending

    int common_prefix(std::uint32_t i, std::uint32_t j) const {
        const std::uint64_t differing = codes[i] ^ codes[j];
        return differing != 0 ? std::countl_zero(differing) : 64 + std::countl_zero(i ^ j);
    }
};
// [common_prefix]

// [prefix_split]
/// Where the range first .. last - 1 of at least two keys is cut: at the first key that has no more
/// in common with the range's first than its last has.
template <class CommonPrefix>
std::uint32_t prefix_split(std::uint32_t first, std::uint32_t last,
                           const CommonPrefix& common_prefix) {
    const int of_all = common_prefix(first, last - 1);
    std::uint32_t before = first, cut = last - 1;  // the last key has of_all in common, no more
    while (cut - before > 1) {
        const std::uint32_t middle = std::midpoint(before, cut);
        (common_prefix(first, middle) > of_all ? before : cut) = middle;
    }
    return cut;
}
// [prefix_split]

/// Limits; costs change no cut.
struct MortonConfig {
    BvhCosts costs = {};  ///< by which the tree's cost is told; the builder asks for none
    std::size_t max_leaf_size = 2;
};

/// The codes have 63 bits in space and 62 in the plane, and places 32: the tree is at most as deep
/// as both have together.
struct MortonBuilder {
    using Config = MortonConfig;

    // [morton_build]
    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        const std::vector<BvhReference<D>> references = boxed<D>(polygons);
        auto [codes, order] = order_of<D>(references);
        std::vector<BvhReference<D>> sorted;
        sorted.reserve(references.size());
        for (const std::uint32_t i : order) sorted.push_back(references[i]);

        const MortonKeys keys{codes};
        const auto cut = [&](const BvhTask<D>& task) -> std::optional<BvhCut<D>> {
            if (task.range.size() <= std::max<std::size_t>(config.max_leaf_size, 1)) return {};
            const auto first = static_cast<std::uint32_t>(task.begin);
            const auto last = static_cast<std::uint32_t>(first + task.range.size());
            const std::uint32_t middle =
                prefix_split(first, last, [&](auto i, auto j) { return keys.common_prefix(i, j); });
            return cut_after<D>(middle - first, task.range);
        };
        return build_top_down<D>(std::move(sorted), config.max_leaf_size, max_bvh_depth, cut,
                                 observer);
    }
    // [morton_build]

    /// References by the codes of their middles.
    template <int D>
    static MortonOrder order_of(std::span<const BvhReference<D>> references) {
        std::vector<Point<D>> middles;
        middles.reserve(references.size());
        for (const BvhReference<D>& reference : references)
            middles.push_back(reference.box.centroid());
        return morton_order<D>(OrthtreeFrame<D>::around(box_around_centroids<D>(references)),
                               middles);
    }
};

}  // namespace space
