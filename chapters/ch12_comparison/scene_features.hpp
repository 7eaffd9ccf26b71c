/// @file
/// What is cheaply seen of a scene before any tree is built over it, in six numbers. They do not
/// change with the order of the triangles, with a scaling by a power of two, or with a translation
/// that rounds no coordinate.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace space {

// [features]
/// All are finite. A scene without a finite triangle has zeros everywhere.
struct SceneFeatures {
    /// log2 of the number of finite triangles; 0 for none.
    double count = 0.0;
    /// log2(1 + boxes of triangles that a random line through the scene's box meets), by the ratio
    /// of surface areas: from 0 to log2(1 + triangles). 0 too for a scene without a surface area.
    double overlap = 0.0;
    /// Octaves from the median to the largest of the triangles' box sizes (longest edge), each
    /// taken as at least 2^-24 of the scene's: 0 (all alike) to 24.
    double spread = 0.0;
    /// Share of the triangles that lie across an axis, nearly: the shortest edge of the box is at
    /// most 2^-10 of the longest. 0 to 1.
    double alignment = 0.0;
    /// Share of empty cells in a grid over the scene's box with at most as many cells as triangles,
    /// each of which is in the cell of its box's centre. 0 to 1.
    double emptiness = 0.0;
    /// log2 of the median of longest side / height above it: 0.2 (equilateral) to 24 (thinner ones
    /// and those without an area); 0 for segments.
    double slenderness = 0.0;
};
// [features]

inline constexpr std::array<std::string_view, 6> feature_names{
    "count", "overlap", "spread", "alignment", "emptiness", "slenderness"};

/// In the order of their names.
inline std::array<double, 6> values(const SceneFeatures& f) {
    return {f.count, f.overlap, f.spread, f.alignment, f.emptiness, f.slenderness};
}

/// The value below which half of them lie (the lower of the two in the middle); there must be one.
template <class T>
T lower_median(std::vector<T>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The sum whatever the order: floating-point addition is not associative.
inline double sum_in_any_order(std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum;
}

/// In double, where no difference of two floats overflows.
template <int D>
Double<D> edges_of(const BasicAabb<D>& box) {
    return Double<D>(box.max) - Double<D>(box.min);
}
template <int D>
double half_area_of(const Double<D>& edges) {
    if constexpr (D == 2)
        return edges.x + edges.y;
    else
        return edges.x * edges.y + edges.y * edges.z + edges.z * edges.x;
}
template <int D>
double longest_of(const Double<D>& edges) {
    double longest = edges[0];
    for (int axis = 1; axis < D; ++axis) longest = std::max(longest, edges[axis]);
    return longest;
}

/// log2 of longest side / height above it, at most 24.
inline float slenderness_of(const Triangle& triangle) {
    const Double3 a(triangle.a), b(triangle.b), c(triangle.c);
    const double longest =  // squared
        std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
    const double double_area = glm::length(normal(triangle));
    if (!(longest < 0x1p24 * double_area)) return 24.0f;
    return static_cast<float>(std::log2(longest / double_area));
}
inline float slenderness_of(const Segment&) {
    return 0.0f;
}

/// The share of the grid's cells without a box's centre. Axes along which the scene has no extent
/// are not cut.
template <int D>
double share_of_empty_cells(std::span<const BasicAabb<D>> boxes, const BasicAabb<D>& scene) {
    const Double<D> edges = edges_of(scene);
    int axes = 0;
    for (int axis = 0; axis < D; ++axis) axes += edges[axis] > 0.0;
    const auto cells_of = [&](std::size_t along) {
        std::size_t cells = 1;
        for (int i = 0; i < axes; ++i) cells *= along;
        return cells;
    };
    std::size_t along = 1;
    while (axes > 0 && cells_of(along + 1) <= boxes.size()) ++along;
    std::vector<bool> is_occupied(cells_of(along));
    for (const BasicAabb<D>& box : boxes) {
        const Double<D> centre = 0.5 * (Double<D>(box.min) + Double<D>(box.max));
        std::size_t cell = 0;
        for (int axis = 0; axis < D; ++axis) {
            if (!(edges[axis] > 0.0)) continue;
            const double place = (centre[axis] - scene.min[axis]) / edges[axis];
            const auto along_axis = static_cast<std::size_t>(place * static_cast<double>(along));
            cell = cell * along + std::min(along_axis, along - 1);
        }
        is_occupied[cell] = true;
    }
    const auto empty = std::count(is_occupied.begin(), is_occupied.end(), false);
    return static_cast<double>(empty) / static_cast<double>(is_occupied.size());
}

/// Some 0.2 s for a million triangles. Those with a coordinate that is not finite are passed over.
template <int D>
SceneFeatures features_of(std::span<const Simplex<D>> polygons) {
    std::vector<BasicAabb<D>> boxes;
    std::vector<float> slenderness;
    std::vector<double> sizes, areas;
    BasicAabb<D> scene;
    std::size_t across_an_axis = 0;
    for (const Simplex<D>& polygon : polygons) {
        const BasicAabb<D> box = box_if_finite<D>(polygon);
        if (box.is_empty()) continue;
        const Double<D> edges = edges_of(box);
        boxes.push_back(box);
        scene.extend(box);
        sizes.push_back(longest_of(edges));
        areas.push_back(half_area_of(edges));
        slenderness.push_back(slenderness_of(polygon));
        double shortest = edges[0];
        for (int axis = 1; axis < D; ++axis) shortest = std::min(shortest, edges[axis]);
        across_an_axis += sizes.back() > 0.0 && shortest <= 0x1p-10 * sizes.back();
    }
    if (boxes.empty()) return {};

    const double scene_area = half_area_of(edges_of(scene));
    for (double& area : areas) area = scene_area > 0.0 ? area / scene_area : 0.0;
    const double least = 0x1p-24 * longest_of(edges_of(scene));
    const double largest = *std::max_element(sizes.begin(), sizes.end());
    const double usual = std::max(lower_median(sizes), least);
    const auto count = static_cast<double>(boxes.size());
    return {.count = std::log2(count),
            .overlap = std::log2(1.0 + sum_in_any_order(areas)),
            .spread = usual > 0.0 ? std::log2(std::max(largest, least) / usual) : 0.0,
            .alignment = static_cast<double>(across_an_axis) / count,
            .emptiness = share_of_empty_cells<D>(boxes, scene),
            .slenderness = double{lower_median(slenderness)}};
}

inline SceneFeatures features_of(std::span<const Triangle> triangles) {
    return features_of<3>(triangles);
}

}  // namespace space
