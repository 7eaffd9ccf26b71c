/// @file
/// Where a secondary ray starts, so that it neither meets the triangle that it leaves nor slips out
/// of a closed mesh between two: beside the plane by a derived distance, and never by "a small
/// epsilon".
#pragma once

#include "chapters/ch01_naive_ray_tracing/shading.hpp"

#include <algorithm>
#include <cmath>

namespace space {

// [offset_origin]
/// The hit point, moved along the normal n (either of the two, of any length) and rounded to
/// floats.
///
/// Let u24 = 2^-24, m the triangle's largest coordinate, P the exact point for the float u and v:
/// it lies in the plane. hit_point gives it in double, off by less than 17 u53 m, and rounding P +
/// offset n to floats moves each coordinate by at most u24 m (1 + 4 u24). Together that is a vector
/// r with |r| < 1.001 sqrt(3) u24 m. For a unit normal k
///     k . (P' - P) = offset (k . n) + k . r > u24 m (4 (k . n) - 1.74):
/// - with k = n the new point is beside the plane, on the right side, by more than 2 u24 m;
/// - with k the normal of a neighbour that P touches, turned by up to 60 degrees, by more than 0.26
///   u24 m. Chapter 1 moves each coordinate by 2 u24 m, along the sign of n's. That is the first,
///   at 0.6 of the distance in the mean, but not this one: where n is nearly an axis, its signs
///   lead up to 1.4 u24 m behind a neighbour (tests/ch02/origins_test.cpp has one).
/// The distance grows with the distance from the world's origin, as the float grid does, whose step
/// has a least size: 2^-150 stands for u24 m where that is more.
inline Point3 offset_origin(const Triangle& triangle, const Hit& hit, const Double3& n) {
    const Aabb box = bounds(triangle);
    const Point3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
    const double offset = 4.0 * float_rounding(std::max({largest.x, largest.y, largest.z}));
    return Point3(hit_point(triangle, hit) + offset * glm::normalize(n));
}
// [offset_origin]

}  // namespace space
