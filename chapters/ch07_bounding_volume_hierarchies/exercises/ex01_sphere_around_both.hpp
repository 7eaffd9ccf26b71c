/// @file
/// Exercise 7.1: The union of two spheres
/// Difficulty 2 of 3, about 30 minutes.
///
/// A tree of spheres needs a sphere around two others. Find the smallest one: around all of both,
/// not around their centres. One may be inside of the other, and one or both may be empty (radius
/// below 0). A radius of 0 is a point.
///
/// Then see to the roundings: the centre and the radius of your answer are floats, and yet it is to
/// contain both, in *exact* arithmetic. So take any centre near the best one, round it, and find
/// the radius last, from the rounded centre. The check allows a radius that is larger by 2^-22 of
/// itself than the smallest about your centre, and a centre that is off by 2^-22 of the largest
/// number in it. Where one sphere is in the other by a margin that double shows, that one is the
/// answer, bit for bit.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bounding_sphere.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace space {

inline BoundingSphere<3> sphere_around_both(const BoundingSphere<3>& a,
                                            const BoundingSphere<3>& b) {
    // TODO: this one contains both, but is as large as if they were far apart on opposite sides
    if (a.is_empty()) return b;
    if (b.is_empty()) return a;
    const double distance = glm::length(Double3(b.centre) - Double3(a.centre));
    return {a.centre, float_above((2.0 * distance + a.radius + b.radius) * (1.0 + 0x1p-40))};
}

}  // namespace space
