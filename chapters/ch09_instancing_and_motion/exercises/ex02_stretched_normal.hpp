/// @file
/// Exercise 9.2: The normal of a stretched sphere
/// Difficulty 2 of 3, about 30 minutes.
///
/// An object is placed by a matrix: any three columns that are not in one plane, so it may stretch,
/// shear and mirror. At a point of its surface the normal is known, in local space. What is the
/// normal there in world space? It stands at right angles to the surface, and points to the same
/// side as before: out of the object where it pointed out of it. Its length is up to you, as long
/// as it is not 0.
///
/// The check uses matrices of small whole numbers, in which everything can be decided exactly;
/// numbers as small as 10^-60 and as large as 10^60; and a sphere that is stretched ten times.
#pragma once

#include "common/geometry.hpp"

#include <glm/mat3x3.hpp>

namespace space {

/// `m` takes a local point p to m p, apart from a translation.
inline Double3 normal_in_world(const glm::dmat3& m, const Double3& normal) {
    return m * normal;  // TODO: right for rotations, and for the same scale along all axes
}

}  // namespace space
