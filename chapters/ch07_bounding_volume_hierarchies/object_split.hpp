/// @file
/// The surface area heuristic over all cuts of one node's references, whose boxes may be those of
/// parts.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/radix_sort.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// A cut of a node's references along an axis, in the order of their boxes' middles, and the tests
/// that a ray through the node is expected to make below.
struct ObjectSplit {
    int axis = 0;
    std::size_t count = 0;  ///< of the first part
    double tests = infinity;
};

/// By the middles of the boxes, of equal ones by the polygons: the bits of both as one number,
/// which is sorted far sooner than references are. (A float's bits grow with it, but for the sign.)
template <int D>
void sort_along(std::span<BvhReference<D>> range, int axis) {
    std::vector<CodedIndex> keys;
    keys.reserve(range.size());
    for (const BvhReference<D>& reference : range) {
        const auto bits = std::bit_cast<std::uint32_t>(reference.box.centroid()[axis] + 0.0f);
        const std::uint32_t middle = (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
        keys.push_back({std::uint64_t{middle} << 32 | reference.polygon,
                        static_cast<std::uint32_t>(keys.size())});
    }
    std::ranges::sort(keys, {}, &CodedIndex::code);
    const std::vector<BvhReference<D>> before(range.begin(), range.end());
    for (std::size_t i = 0; i < keys.size(); ++i) range[i] = before[keys[i].index];
}

/// The cheapest of all cuts along all axes, of at least two. SweepBuilder sorts once; here each
/// node has boxes that are new.
template <int D>
ObjectSplit best_object_split(std::span<BvhReference<D>> range, const HitChance<D>& chance) {
    ObjectSplit best;
    std::vector<double> above(range.size());  // the weight of the box around a reference and later
    for (int axis = 0; axis < D; ++axis) {
        sort_along(range, axis);
        BasicAabb<D> box;
        for (std::size_t i = range.size(); i-- > 1;) {
            box.extend(range[i].box);
            above[i] = chance.weight(box);
        }
        box = {};
        for (std::size_t i = 1; i < range.size(); ++i) {
            box.extend(range[i - 1].box);
            const double tests =
                chance.weight(box) * double(i) + above[i] * double(range.size() - i);
            if (tests < best.tests) best = {axis, i, tests};
        }
    }
    best.tests /= chance.whole();
    return best;
}

}  // namespace space
