/// @file
/// Exercise 9.3, a near miss: the determinant of the whole way, as one product. It is the right
/// rule, and right for every path of a handful of matrices. Then the product becomes 0.
#pragma once

#include "common/geometry.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <span>

namespace space {

inline bool is_mirrored(std::span<const glm::dmat3> path) {
    double determinant = 1.0;
    for (const glm::dmat3& m : path) determinant *= glm::determinant(m);
    return determinant < 0.0;
}

/// Of a ray that hits the triangle; it does not run in its plane.
inline bool sees_front(const Vector3& direction, const Triangle& world,
                       std::span<const glm::dmat3> path) {
    return (glm::dot(normal(world), Double3(direction)) < 0.0) != is_mirrored(path);
}

inline Triangle with_front_restored(const Triangle& world, std::span<const glm::dmat3> path) {
    return is_mirrored(path) ? Triangle{world.a, world.c, world.b} : world;
}

}  // namespace space
