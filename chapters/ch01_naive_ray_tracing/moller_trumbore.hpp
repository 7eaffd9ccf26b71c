/// @file
/// The ray-triangle test of Möller & Trumbore 1997, "Fast, Minimum Storage Ray-Triangle
/// Intersection".
#pragma once

#include "common/accelerator.hpp"

#include <concepts>
#include <optional>

namespace space {

/// A ray-triangle test: a hit of the ray with the closed triangle, its index left at 0, or nothing.
/// Chapter 2 has many of them.
template <class T>
concept TriangleTest = requires(const Ray& ray, const Triangle& triangle) {
    { T::intersect(ray, triangle) } -> std::same_as<std::optional<Hit>>;
};

/// Solves origin + t direction = a + u (b - a) + v (c - a) by Cramer's rule, in `Real` arithmetic.
/// The coordinates are floats; the result is rounded to float once, and t is compared with the
/// interval after rounding, so that the nearest hit does not depend on the order in which triangles
/// are tested.
template <std::floating_point Real>
struct BasicMollerTrumbore {
    using Real3 = glm::vec<3, Real>;

    // [moller_trumbore]
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        const Real3 direction{ray.direction};
        const Real3 a{triangle.a}, ab = Real3(triangle.b) - a, ac = Real3(triangle.c) - a;
        const Real3 p = glm::cross(direction, ac);
        const Real determinant = glm::dot(p, ab);
        if (determinant == 0)
            return std::nullopt;  // parallel to the triangle, or a triangle without area

        const Real3 s = Real3(ray.origin) - a;
        const Real u = glm::dot(p, s) / determinant;
        if (!(u >= 0 && u <= 1)) return std::nullopt;
        const Real3 q = glm::cross(s, ab);
        const Real v = glm::dot(q, direction) / determinant;
        if (!(v >= 0 && u + v <= 1)) return std::nullopt;
        if (glm::cross(ab, ac) == Real3(0))
            return std::nullopt;  // no area, but a determinant of rounding errors

        const auto t = static_cast<float>(glm::dot(q, ac) / determinant);
        if (!(t >= ray.tmin && t <= ray.tmax)) return std::nullopt;  // also where t is not a number
        return Hit{.t = t, .u = static_cast<float>(u), .v = static_cast<float>(v)};
    }
    // [moller_trumbore]
};

/// Chapter 1's test. It decides nearly always as exact arithmetic does; now and then it says "hit"
/// outside of the triangle, near an edge, where a structure that knows the ray's place does not
/// look, so over this test no structure can be proved to answer as the naive loop does; over
/// chapter 2's FilteredExact it can. In float the test misses rays near the edges (figure 1.9;
/// chapter 2 has more).
using MollerTrumbore = BasicMollerTrumbore<double>;

}  // namespace space
