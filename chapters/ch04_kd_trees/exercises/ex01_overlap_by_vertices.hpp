/// @file
/// Exercise 4.1: Overlap by vertices
/// Difficulty 1 of 3, about 20 minutes.
///
/// Below stands the rule of the published tree: a half names a triangle if it holds a corner of it.
/// Where straddlers go down into both halves, cells soon get smaller than triangles, and a triangle
/// that spans a cell has no corner in it. Write the rule that looks at the triangle's bounding box.
/// What counts is the box's part in the cell, and the triangle is known to reach into the cell or
/// to touch it. A half names the triangle if this part reaches beyond the plane into the half. What
/// only touches the plane from one side is not named on the other. What lies in the plane is named
/// once, by the half that the split says. Checked on triangles that touch, span and miss corners,
/// on halves without thickness, and in trees, leaf by leaf: no reference is lost, and none is
/// there that only a wider rule would add.
#pragma once

#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "common/geometry.hpp"

namespace space {

/// Which halves of a cell name a triangle.
struct NamedBy {
    bool below, above;
};

inline NamedBy named_by(const Triangle& triangle, const Aabb& cell, const KdSplit& split) {
    // TODO: this loses triangles without a corner in the cell
    const auto [below, above] = halves(cell, split);
    const auto holds_a_corner = [&](const Aabb& half) {
        return half.contains(triangle.a) || half.contains(triangle.b) || half.contains(triangle.c);
    };
    return {holds_a_corner(below), holds_a_corner(above)};
}

}  // namespace space
