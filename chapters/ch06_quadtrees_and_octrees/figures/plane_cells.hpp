/// @file
/// Cells of quadtrees as drawings show them.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/program/plane_view.hpp"

#include <algorithm>

namespace space::ch06 {

/// The corners of a box in order.
inline ConvexCell corners_of(const OrthtreeBox<2>& box) {
    return {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
}

/// What two boxes have in common; min > max on an axis where that is nothing.
inline OrthtreeBox<2> common_part(const OrthtreeBox<2>& a, const OrthtreeBox<2>& b) {
    return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}
inline bool is_empty(const OrthtreeBox<2>& box) {
    return box.min.x >= box.max.x || box.min.y >= box.max.y;
}

}  // namespace space::ch06
