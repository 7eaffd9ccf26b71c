/// @file
/// Exercise 11.1, our answer: a point uniform on the disc below the hemisphere, lifted up to it.
#pragma once

#include "common/geometry.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace space {

/// A direction of length 1 on the side of `n`; both numbers of `u` are at least 0 and less than 1.
inline Double3 cosine_direction(const Double3& n, const Double2& u) {
    const Double3 aside = std::abs(n.x) < 0.5 ? Double3(1, 0, 0) : Double3(0, 1, 0);
    const Double3 x = glm::normalize(glm::cross(aside, n)), y = glm::cross(n, x);
    const double radius = std::sqrt(u.x), angle = 2.0 * std::numbers::pi * u.y;
    return radius * std::cos(angle) * x + radius * std::sin(angle) * y + std::sqrt(1.0 - u.x) * n;
}

/// How densely cosine_direction covers this direction, which has length 1, per solid angle; 0 below
/// the surface.
inline double cosine_density(const Double3& n, const Double3& direction) {
    return std::max(0.0, glm::dot(n, direction)) / std::numbers::pi;
}

}  // namespace space
