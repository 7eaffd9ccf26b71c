/// @file
/// Exercise 4.1, a near miss: a half names what reaches beyond the plane, and so no half names what
/// lies in it. In a scene of slanted triangles nobody notices; in a house all walls are gone that
/// a plane happens to run through, and the best planes run through walls.
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
    return {low<split.position, high> split.position};
}

}  // namespace space
