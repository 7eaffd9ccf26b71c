/// @file
/// Exercise 5.4: Bounds of a patch
/// Difficulty 2 of 3, about 25 minutes.
///
/// A patch of a coarse mesh is to become many small triangles. With weights that are not negative
/// and have the sum 1, each of their points is the mean of the corners, moved along the same mean
/// of the ways outwards, by a height from `lowest` to `highest`; the heights are not known before
/// the patch is made. Return a box that holds all of its points, computed in double and rounded to
/// the nearest floats, and that is no larger than it must be: on no side farther out than the exact
/// box of all possible points, but for some roundings of float.
#pragma once

#include "common/geometry.hpp"

#include <array>

namespace space {

/// A triangle of a coarse mesh, the ways outwards at its corners, and between which heights its
/// bumps are.
struct CoarsePatch {
    std::array<Point3, 3> corners;
    std::array<Vector3, 3> outwards;  ///< of any length
    float lowest, highest;
};

inline Aabb bounds_of(const CoarsePatch& patch) {
    // TODO: the box of the corners, made wider by the largest step on all sides: true, but large
    const float step = glm::max(glm::abs(patch.lowest), glm::abs(patch.highest));
    float longest = 0.0f;
    for (const Vector3& way : patch.outwards) longest = glm::max(longest, glm::length(way));
    Aabb box;
    for (const Point3& corner : patch.corners) {
        box.extend(corner - Vector3(1.01f * step * longest));
        box.extend(corner + Vector3(1.01f * step * longest));
    }
    return box;
}

}  // namespace space
