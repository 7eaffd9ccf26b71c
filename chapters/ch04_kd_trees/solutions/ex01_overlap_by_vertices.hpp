/// @file
/// Exercise 4.1, our answer.
#pragma once

#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "common/geometry.hpp"

#include <algorithm>

namespace space {

/// Which halves of a cell name a triangle.
struct NamedBy {
    bool below, above;
};

inline NamedBy named_by(const Triangle& triangle, const Aabb& cell, const KdSplit& split) {
    const Aabb box = bounds(triangle);
    const float low = std::max(box.min[split.axis], cell.min[split.axis]);
    const float high = std::min(box.max[split.axis], cell.max[split.axis]);
    const bool is_below = low < split.position;
    const bool is_above = high > split.position;
    if (!is_below && !is_above) return {split.coplanar_below, !split.coplanar_below};
    return {is_below, is_above};
}

}  // namespace space
