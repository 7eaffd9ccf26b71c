/// @file
/// Exercise 6.3: The order of octants
/// Difficulty 2 of 3, about 40 minutes.
///
/// A ray meets the root of an octree. Return the numbers of the children that it passes, in the
/// order in which it comes to them; bit `axis` of a number is set for the upper half. Children are
/// half-open as in exercise 6.1: a point in a middle plane is in the upper half, and all faces of
/// the root belong to it. A child is passed if more than one point of the ray is in it: a ray that
/// crosses two planes at once comes to the child beyond both, and one that only touches the root
/// passes none. The ray ends at `tmin` and `tmax`, and may do so within the root; it may lie in
/// planes and faces. Components of its direction may be negative, 0 and -0, which is the same. It
/// is valid. All coordinates, those of the root's corners and centre, too, are whole numbers of at
/// most six digits, `tmin` and `tmax` are multiples of 1/4, but `tmax` may be infinite: quotients
/// of differences, as doubles, are equal to each other or to these just where the exact ones are,
/// and else in the right order.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace space {

inline std::vector<std::uint32_t> children_along(const OrthtreeBox<3>& /*root*/,
                                                 const Ray& /*ray*/) {
    // TODO: these are all children, and their order is that of their numbers for every ray
    return {0, 1, 2, 3, 4, 5, 6, 7};
}

}  // namespace space
