/// @file
/// Möller & Trumbore's test in the precision it is usually written in: chapter 1's, with floats throughout.
#pragma once

#include <optional>

#include "common/accelerator.hpp"

namespace space {

/// Compares the determinant with zero only: an absolute epsilon misses small triangles (CATALOGUE of the chapter, T4).
struct MollerTrumboreFloat {
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        const Vector3 ab = triangle.b - triangle.a, ac = triangle.c - triangle.a;
        const Vector3 p = glm::cross(ray.direction, ac);
        const float determinant = glm::dot(p, ab);
        if (determinant == 0.0f) return std::nullopt;
        const float inverse = 1.0f / determinant;

        const Vector3 s = ray.origin - triangle.a;
        const float u = glm::dot(p, s) * inverse;
        if (!(u >= 0.0f && u <= 1.0f)) return std::nullopt;
        const Vector3 q = glm::cross(s, ab);
        const float v = glm::dot(q, ray.direction) * inverse;
        if (!(v >= 0.0f && u + v <= 1.0f)) return std::nullopt;

        const float t = glm::dot(q, ac) * inverse;
        if (!(t >= ray.tmin && t <= ray.tmax)) return std::nullopt;
        return Hit{.t = t, .u = u, .v = v};
    }
};

}  // namespace space
