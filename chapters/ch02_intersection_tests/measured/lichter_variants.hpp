/// @file
/// Between Lichter23's first test and the improved one: each change with and without the others, to
/// tell what brings the gain (claim L2).
#pragma once

#include "chapters/ch02_intersection_tests/lichter.hpp"

#include <utility>

namespace space::ch02 {

/// The first test with some of the changes. Roots set errno, so that no compiler moves them across
/// a branch.
/// @tparam exits       out as soon as t is outside the interval, and at each edge; else all is
///                     computed before anything is decided, as in the first
/// @tparam roots_last  u and v for hits only; else before the edge tests
/// @tparam roots       three, or two of quotients
template <bool exits, bool roots_last, int roots>
struct LichterVariant {
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        const auto& [a, b, c] = triangle;
        const Vector3 n = glm::cross(b - a, c - a);
        const float slope = glm::dot(n, ray.direction);
        if (std::abs(slope) < lichter_epsilon) return std::nullopt;
        const float t = glm::dot(n, a - ray.origin) / slope;
        const bool in_interval = t >= ray.tmin && t <= ray.tmax;
        if (exits && !in_interval) return std::nullopt;

        const Point3 p = ray.at(t);
        const Vector3 of_c = glm::cross(b - a, p - a), of_a = glm::cross(c - b, p - b),
                      of_b = glm::cross(a - c, p - c);
        std::pair<float, float> uv;
        if (!roots_last) uv = weights(n, of_b, of_c);
        if constexpr (exits) {
            if (glm::dot(of_c, n) < 0.0f) return std::nullopt;
            if (glm::dot(of_a, n) < 0.0f) return std::nullopt;
            if (glm::dot(of_b, n) < 0.0f) return std::nullopt;
        } else {
            const float c_side = glm::dot(of_c, n), a_side = glm::dot(of_a, n),
                        b_side = glm::dot(of_b, n);
            if (a_side < 0.0f || b_side < 0.0f || c_side < 0.0f || !in_interval)
                return std::nullopt;
        }
        if (roots_last) uv = weights(n, of_b, of_c);
        return finite({.t = t, .u = uv.first, .v = uv.second});
    }

  private:
    static std::pair<float, float> weights(const Vector3& n, const Vector3& of_b,
                                           const Vector3& of_c) {
        if constexpr (roots == 3) {
            const float length = std::sqrt(glm::dot(n, n));
            return {std::sqrt(glm::dot(of_b, of_b)) / length,
                    std::sqrt(glm::dot(of_c, of_c)) / length};
        } else {
            const float square = glm::dot(n, n);
            return {std::sqrt(glm::dot(of_b, of_b) / square),
                    std::sqrt(glm::dot(of_c, of_c) / square)};
        }
    }
};

}  // namespace space::ch02
