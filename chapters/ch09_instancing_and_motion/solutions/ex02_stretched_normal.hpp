/// @file
/// Exercise 9.2, our answer: the transpose of the inverse, times the determinant's size.
#pragma once

#include "common/geometry.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace space {

/// `m` takes a local point p to m p, apart from a translation.
inline Double3 normal_in_world(const glm::dmat3& m, const Double3& normal) {
    const Double3 across = glm::cross(m[1], m[2]);
    const Double3 of_edges =
        normal.x * across + normal.y * glm::cross(m[2], m[0]) + normal.z * glm::cross(m[0], m[1]);
    return glm::dot(m[0], across) < 0.0 ? -of_edges : of_edges;
}

}  // namespace space
