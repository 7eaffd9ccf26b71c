/// @file
/// Polygons with their boxes: what builders sort, cut into ranges and hand on.
#pragma once

#include "common/geometry.hpp"
#include "common/limit_error.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

// [boxed]
/// A polygon as a builder sees it: where it is, and which. In 28 bytes: builders move these, not
/// indices of boxes elsewhere in memory.
template <int D>
struct BvhReference {
    BasicAabb<D> box;  ///< of the polygon, or of the part of it that this reference stands for
    std::uint32_t polygon;
};

/// @throws LimitError for more than 2^31 polygons: their tree may have twice as many nodes
inline void limit_polygons(std::size_t count) {
    if (count > std::size_t{1} << 31)
        throw LimitError("bounding volume hierarchy: more than 2147483648 polygons");
}

/// The polygons with their boxes, in their order, but for those that are not finite.
template <int D>
std::vector<BvhReference<D>> boxed(std::span<const Simplex<D>> polygons) {
    limit_polygons(polygons.size());
    std::vector<BvhReference<D>> all;
    all.reserve(polygons.size());
    for (std::uint32_t i = 0; i < polygons.size(); ++i) {
        const BasicAabb<D> box = box_if_finite<D>(polygons[i]);
        if (!box.is_empty()) all.push_back({box, i});
    }
    return all;
}
// [boxed]

/// The box around all.
template <int D>
BasicAabb<D> box_around(std::span<const BvhReference<D>> references) {
    BasicAabb<D> box;
    for (const BvhReference<D>& reference : references) box.extend(reference.box);
    return box;
}

/// The box around the middles of all boxes.
template <int D>
BasicAabb<D> box_around_centroids(std::span<const BvhReference<D>> references) {
    BasicAabb<D> box;
    for (const BvhReference<D>& reference : references) box.extend(reference.box.centroid());
    return box;
}

}  // namespace space
