/// @file
/// Exercise 7.1, our answer.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bounding_sphere.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace space {

inline BoundingSphere<3> sphere_around_both(const BoundingSphere<3>& a,
                                            const BoundingSphere<3>& b) {
    const Double3 way = Double3(b.centre) - Double3(a.centre);
    const double distance = glm::length(way);
    if (b.is_empty() || (!a.is_empty() && distance + b.radius <= a.radius)) return a;
    if (a.is_empty() || distance + a.radius <= b.radius) return b;
    const double radius = 0.5 * (a.radius + distance + b.radius);
    const Point3 centre(Double3(a.centre) + (radius - a.radius) / distance * way);
    const auto up_to = [&](const BoundingSphere<3>& sphere) {
        return glm::length(Double3(sphere.centre) - Double3(centre)) + sphere.radius;
    };
    return {centre, float_above(std::max(up_to(a), up_to(b)) * (1.0 + 0x1p-49))};
}

}  // namespace space
