/// @file
/// One ray-triangle test, Möller & Trumbore's in float, in three orders, to see what an early exit
/// is worth (Optim25, section 2). All three compute the same numbers and give the same answers.
#pragma once

#include "common/accelerator.hpp"

#include <optional>

namespace space {

/// Out as soon as a number excludes a hit; what is cheap and excludes much comes first.
struct CheapFirst {
    // [cheap_first]
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
    // [cheap_first]
};

/// No early exit: everything is computed, one decision at the end.
struct DecideLast {
    // [decide_last]
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        const Vector3 ab = triangle.b - triangle.a, ac = triangle.c - triangle.a,
                      s = ray.origin - triangle.a;
        const Vector3 p = glm::cross(ray.direction, ac), q = glm::cross(s, ab);
        const float determinant = glm::dot(p, ab), inverse = 1.0f / determinant;
        const float u = glm::dot(p, s) * inverse, v = glm::dot(q, ray.direction) * inverse,
                    t = glm::dot(q, ac) * inverse;
        // & evaluates both sides: no branch between the comparisons.
        const bool hits = (determinant != 0.0f) & (u >= 0.0f) & (u <= 1.0f) & (v >= 0.0f) &
                          (u + v <= 1.0f) & (t >= ray.tmin) & (t <= ray.tmax);
        if (!hits) return std::nullopt;
        return Hit{.t = t, .u = u, .v = v};
    }
    // [decide_last]
};

/// Early exits in the wrong order: first t, which needs everything and excludes little, then u and
/// v.
struct ExpensiveFirst {
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        const Vector3 ab = triangle.b - triangle.a, ac = triangle.c - triangle.a,
                      s = ray.origin - triangle.a;
        const Vector3 p = glm::cross(ray.direction, ac);
        const float determinant = glm::dot(p, ab);
        if (determinant == 0.0f) return std::nullopt;
        const float inverse = 1.0f / determinant;
        const Vector3 q = glm::cross(s, ab);
        const float t = glm::dot(q, ac) * inverse;
        if (!(t >= ray.tmin && t <= ray.tmax)) return std::nullopt;
        const float v = glm::dot(q, ray.direction) * inverse;
        if (!(v >= 0.0f)) return std::nullopt;
        const float u = glm::dot(p, s) * inverse;
        if (!(u >= 0.0f && u <= 1.0f && u + v <= 1.0f)) return std::nullopt;
        return Hit{.t = t, .u = u, .v = v};
    }
};

}  // namespace space
