/// @file
/// Exercise 6.4, our answer.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace space {

inline OrthtreeCell<3> loose_cell_of(const Triangle& triangle, float edge) {
    const Aabb box = bounds(triangle);
    const Double3 low(box.min), high(box.max);
    const Double3 sides = high - low, centre = 0.5 * (low + high);
    const double size = std::max({sides.x, sides.y, sides.z});
    OrthtreeCell<3> cell;
    double cell_edge = edge;
    while (cell.depth < 21 && size <= 0.5 * cell_edge) {
        cell_edge *= 0.5;
        ++cell.depth;
    }
    const double last = std::ldexp(1.0, int(cell.depth)) - 1.0;
    for (int axis = 0; axis < 3; ++axis)
        cell.place[std::size_t(axis)] =
            static_cast<std::uint32_t>(std::min(centre[axis] / cell_edge, last));
    return cell;
}

}  // namespace space
