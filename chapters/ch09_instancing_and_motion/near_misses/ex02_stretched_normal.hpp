/// @file
/// Exercise 9.2, a near miss: the matrix of cofactors, which is the transpose of the inverse times
/// the determinant. "The length does not matter" - but a length does not have a sign: the normals
/// of mirrored objects point inwards.
#pragma once

#include "common/geometry.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace space {

/// `m` takes a local point p to m p, apart from a translation.
inline Double3 normal_in_world(const glm::dmat3& m, const Double3& normal) {
    return normal.x * glm::cross(m[1], m[2]) + normal.y * glm::cross(m[2], m[0]) +
           normal.z * glm::cross(m[0], m[1]);
}

}  // namespace space
