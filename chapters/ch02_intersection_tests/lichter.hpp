/// @file
/// The two ray-triangle tests that Lichter23, section 1, compares: plane hit, then the side of
/// every edge.
#pragma once

#include "common/accelerator.hpp"

#include <cmath>
#include <optional>

namespace space {

/// |n . d| below this counts as parallel. The normal n has the length of twice the triangle's area
/// and d any length, so the number has no meaning of its own: small triangles are never hit
/// (chapter 2, "where it fails"). Lichter23 names an EPSILON and gives no value; this is the usual
/// one.
inline constexpr float lichter_epsilon = 1e-6f;

/// No hit where a product overflowed.
inline std::optional<Hit> finite(const Hit& hit) {
    return std::isfinite(hit.t + hit.u + hit.v) ? std::optional(hit) : std::nullopt;
}

/// As Lichter23 starts: u and v are lengths of cross products over the length of the normal, three
/// square roots.
struct LichterFirst {
    // [lichter_first]
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        const auto& [a, b, c] = triangle;
        const Vector3 n = glm::cross(b - a, c - a);
        const float slope = glm::dot(n, ray.direction);
        if (std::abs(slope) < lichter_epsilon) return std::nullopt;
        const float t = glm::dot(n, a - ray.origin) / slope;
        const Point3 p = ray.at(t);
        const Vector3 of_c = glm::cross(b - a, p - a), of_a = glm::cross(c - b, p - b),
                      of_b = glm::cross(a - c, p - c);
        const float length = std::sqrt(glm::dot(n, n));
        const float u = std::sqrt(glm::dot(of_b, of_b)) / length,
                    v = std::sqrt(glm::dot(of_c, of_c)) / length;
        if (glm::dot(of_a, n) < 0.0f || glm::dot(of_b, n) < 0.0f || glm::dot(of_c, n) < 0.0f)
            return std::nullopt;
        if (!(t >= ray.tmin && t <= ray.tmax)) return std::nullopt;
        return finite({.t = t, .u = u, .v = v});
    }
    // [lichter_first]
};

/// As it ends: out as soon as t is outside the interval (pass the nearest t so far as tmax), u and
/// v last, and the squared lengths divided before the root, two square roots.
struct LichterImproved {
    // [lichter_improved]
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        const auto& [a, b, c] = triangle;
        const Vector3 n = glm::cross(b - a, c - a);
        const float slope = glm::dot(n, ray.direction);
        if (std::abs(slope) < lichter_epsilon) return std::nullopt;
        const float t = glm::dot(n, a - ray.origin) / slope;
        if (!(t >= ray.tmin && t <= ray.tmax)) return std::nullopt;
        const Point3 p = ray.at(t);
        const Vector3 of_c = glm::cross(b - a, p - a);
        if (glm::dot(of_c, n) < 0.0f) return std::nullopt;
        if (glm::dot(glm::cross(c - b, p - b), n) < 0.0f) return std::nullopt;
        const Vector3 of_b = glm::cross(a - c, p - c);
        if (glm::dot(of_b, n) < 0.0f) return std::nullopt;
        const float square = glm::dot(n, n);
        return finite({.t = t,
                       .u = std::sqrt(glm::dot(of_b, of_b) / square),
                       .v = std::sqrt(glm::dot(of_c, of_c) / square)});
    }
    // [lichter_improved]
};

}  // namespace space
