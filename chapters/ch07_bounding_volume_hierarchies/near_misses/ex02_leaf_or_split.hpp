/// @file
/// Exercise 7.2, a near miss: the sum of the children's surfaces without their counts, as a course
/// note has it. Small boxes win, though nearly all triangles may be in the large one.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace space {

/// A part of a node's triangles, with their box.
struct Part {
    Aabb box;
    std::size_t count = 0;
};

/// One way to cut them; neither part is empty.
struct PossibleCut {
    Part first, second;
};

/// The index of the best cut; nothing for a leaf.
inline std::optional<std::size_t> best_cut(const Part& node, std::span<const PossibleCut> cuts,
                                           const BvhCosts& costs) {
    const auto edges = [](const Aabb& box) { return Double3(box.max) - Double3(box.min); };
    const auto area = [&](const Aabb& box) {
        const Double3 e = edges(box);
        return e.x * e.y + e.y * e.z + e.z * e.x;
    };
    const auto length = [&](const Aabb& box) {
        const Double3 e = edges(box);
        return e.x + e.y + e.z;
    };
    const auto size = [&](const Aabb& box) {
        return area(node.box) > 0.0 ? area(box) : length(node.box) > 0.0 ? length(box) : 1.0;
    };
    std::optional<std::size_t> best;
    double least = costs.intersection * double(node.count);
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        const double chances =
            (size(cuts[i].first.box) + size(cuts[i].second.box)) / size(node.box);
        const double tests = 0.5 * double(node.count) * chances;
        const double cost = costs.traversal + costs.intersection * tests;
        if (cost < least) {
            least = cost;
            best = i;
        }
    }
    return best;
}

}  // namespace space
