/// @file
/// Exercise 6.4, a near miss: the size and the centre are the box's own, in float. A centre half a
/// float below a plane is rounded up into it, and so into the next cell, which may not reach all of
/// the box.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace space {

inline OrthtreeCell<3> loose_cell_of(const Triangle& triangle, float edge) {
    const Aabb box = bounds(triangle);
    const Vector3 sides = box.extent();
    const Point3 centre = box.centroid();
    const float size = std::max({sides.x, sides.y, sides.z});
    OrthtreeCell<3> cell;
    float cell_edge = edge;
    while (cell.depth < 21 && size <= 0.5f * cell_edge) {
        cell_edge *= 0.5f;
        ++cell.depth;
    }
    const float last = std::ldexp(1.0f, int(cell.depth)) - 1.0f;
    for (int axis = 0; axis < 3; ++axis)
        cell.place[std::size_t(axis)] =
            static_cast<std::uint32_t>(std::min(centre[axis] / cell_edge, last));
    return cell;
}

}  // namespace space
