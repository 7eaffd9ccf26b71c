/// @file
/// Exercise 9.1: The order of T, R and S
/// Difficulty 1 of 3, about 20 minutes.
///
/// A placement scales an object along its own axes, then turns it, then moves it: *M = T R S*.
/// Write the way there, and the way back, by *S^-1 R^T T^-1*, for points and for directions.
/// `rotation` has the images of the three axes as its columns, and nothing but a rotation in it; no
/// component of `scale` is 0, but some may be negative.
///
/// The check uses rotations, scales and translations for which every step is exact, so your answers
/// must be, too, and it compares a ray's points in both spaces at the same *t*. A general inverse
/// of a matrix is not available to you.
#pragma once

#include "common/geometry.hpp"

#include <glm/mat3x3.hpp>

namespace space {

struct Placed {
    Double3 translation{0.0};
    glm::dmat3 rotation{1.0};
    Double3 scale{1.0};
};

inline Double3 point_to_world(const Placed& placed, const Double3& p) {
    return p + placed.translation;  // TODO: R and S, each in its place
}

inline Double3 point_to_local(const Placed& placed, const Double3& q) {
    return q - placed.translation;  // TODO
}

/// Of a ray: so that at each t the point is the same one in both spaces.
inline Double3 direction_to_local(const Placed& placed, const Double3& d) {
    return placed.rotation * d;  // TODO
}

}  // namespace space
