/// @file
/// Signed volumes, also called Plücker coordinates: the ray passes a triangle inside if it turns
/// the same way around all three edges (Platis & Theoharis 2003; in the edge form of Embree's
/// robust mode).
#pragma once

#include "common/accelerator.hpp"

#include <cmath>
#include <optional>

namespace space {

/// Decides by the signs of the three volumes of the ray with the edges.
struct Plucker {
    // [plucker]
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        const Vector3 a = triangle.a - ray.origin, b = triangle.b - ray.origin,
                      c = triangle.c - ray.origin;
        // (q - p) x (q + p) = 2 q x p is exactly opposite when p and q change places, also after
        // rounding.
        const Vector3 ab = b - a, bc = c - b, ca = a - c;
        const float w = glm::dot(glm::cross(ab, b + a), ray.direction);
        const float u = glm::dot(glm::cross(bc, c + b), ray.direction);
        const float v = glm::dot(glm::cross(ca, a + c), ray.direction);
        if ((u < 0.0f || v < 0.0f || w < 0.0f) && (u > 0.0f || v > 0.0f || w > 0.0f))
            return std::nullopt;
        const float sum = u + v + w;
        const Vector3 n = glm::cross(b - a, c - a);
        const float slope = glm::dot(n, ray.direction);
        if (slope == 0.0f || sum == 0.0f || !std::isfinite(sum)) return std::nullopt;
        const float t = glm::dot(n, a) / slope;
        if (!(t >= ray.tmin && t <= ray.tmax) || std::isinf(t)) return std::nullopt;
        return Hit{.t = t, .u = v / sum, .v = w / sum};
    }
    // [plucker]
};

}  // namespace space
