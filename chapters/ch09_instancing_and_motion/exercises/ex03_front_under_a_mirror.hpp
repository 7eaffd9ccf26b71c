/// @file
/// Exercise 9.3: The front side under a mirror
/// Difficulty 2 of 3, about 30 minutes.
///
/// The front side of a triangle is the one that (b - a) x (c - a) points to, in the space in which
/// the object was made. The object is placed, in a group that is placed, and so on: `path` has the
/// matrices from the outermost to the innermost one, without their translations, and a world
/// triangle is the local one taken through all of them. Its vertices stand in their old order.
///
/// A ray has hit it. Does it see the side that was the front side when the object was made?
///
/// Then write the triangle in an order of its vertices in which the plain rule holds in world
/// space. Vertex a stays vertex a. Where nothing has to be done, nothing is.
///
/// No matrix is singular, but there may be 200 of them, and their scales reach from 10^-40 to
/// 10^40.
#pragma once

#include "common/geometry.hpp"

#include <glm/mat3x3.hpp>

#include <span>

namespace space {

/// Of a ray that hits the triangle; it does not run in its plane.
inline bool sees_front(const Vector3& direction, const Triangle& world,
                       std::span<const glm::dmat3> /*path*/) {
    return glm::dot(normal(world), Double3(direction)) < 0.0;  // TODO: mirrors
}

inline Triangle with_front_restored(const Triangle& world, std::span<const glm::dmat3> /*path*/) {
    return world;  // TODO
}

}  // namespace space
