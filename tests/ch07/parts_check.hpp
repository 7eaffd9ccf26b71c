/// @file
/// What must be so in trees whose leaves name parts of triangles.
#pragma once

#include "tests/ch07/bvh_trees.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace space {

/// Points of a polygon in a grid, corners among them. Their coordinates are exact in double where a
/// polygon's own differ by less than 2^25.
template <int D>
std::vector<Double<D>> grid_points(const Simplex<D>& polygon) {
    constexpr int steps = 8;
    std::vector<Double<D>> points;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= (D == 2 ? i : steps); ++j) {
            Double<D> p =
                double(i) * Double<D>(polygon[0]) + double(steps - i - j) * Double<D>(polygon[1]);
            if constexpr (D == 3) p += double(j) * Double<D>(polygon[2]);
            points.push_back(p / double(steps));
        }
    return points;
}

/// Faults of a tree in which a polygon may be named by several leaves: each point of a polygon is
/// in one that names it. Those that `needed` is false for may be in none.
template <int D, class Needed>
std::string faults_of_parts(const BvhNodes<D>& tree, std::span<const Simplex<D>> polygons,
                            std::size_t max_leaf_size, const Needed& needed) {
    auto faults = layout_faults(tree);
    std::vector<std::vector<BasicAabb<D>>> boxes(polygons.size());
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        const auto own = tree.own(index);
        if (own.size() > max_leaf_size) faults.push_back(fmt::format("leaf {}: large", index));
        if (std::ranges::adjacent_find(own, std::ranges::greater_equal{}) != own.end())
            faults.push_back(fmt::format("leaf {}: out of order, or one twice", index));
        for (const std::uint32_t polygon : own) boxes[polygon].push_back(tree.nodes[index].box);
    });
    const auto holds = [](const BasicAabb<D>& box, const Double<D>& p) {
        return glm::all(glm::lessThanEqual(Double<D>(box.min), p)) &&
               glm::all(glm::lessThanEqual(p, Double<D>(box.max)));
    };
    for (std::uint32_t i = 0; i < polygons.size(); ++i) {
        if (!needed(polygons[i])) continue;
        for (const Double<D>& p : grid_points<D>(polygons[i]))
            if (std::ranges::none_of(boxes[i], [&](const auto& box) { return holds(box, p); })) {
                faults.push_back(fmt::format("polygon {}: a point in no leaf that names it", i));
                break;
            }
    }
    return diagnosis(faults);
}

}  // namespace space
