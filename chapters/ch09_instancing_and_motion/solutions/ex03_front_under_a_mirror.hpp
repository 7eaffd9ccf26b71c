/// @file
/// Exercise 9.3, our answer.
#pragma once

#include "common/geometry.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <span>

namespace space {

/// Signs are counted, not multiplied: a product of determinants may come out as 0. A column at a
/// time is made as large as 1: so may one determinant.
inline bool is_mirrored(std::span<const glm::dmat3> path) {
    bool mirrored = false;
    for (const glm::dmat3& m : path)
        mirrored ^= glm::determinant(glm::dmat3(glm::normalize(m[0]), glm::normalize(m[1]),
                                                glm::normalize(m[2]))) < 0.0;
    return mirrored;
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
