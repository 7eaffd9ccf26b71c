/// @file
/// Exercise 10.5, a near miss: the bound is a part of the determinant, as if that were known to
/// some digits. Where a triangle is seen from the side, or from far away, the determinant is what
/// large terms have left, and its error is not.
#pragma once

#include "common/geometry.hpp"

#include <array>
#include <cmath>

namespace space {

/// Corners of four triangles by component: a[axis][lane].
struct FourTriangles {
    std::array<std::array<float, 4>, 3> a, b, c;
};

/// How far x lies outside of the interval between 0 and `end`: negative inside, 0 at both ends.
inline float outside(float x, float end) {
    const float half = 0.5f * end;
    return std::abs(x - half) - std::abs(half);
}

/// A bit for each lane, of lane 0 the lowest.
inline unsigned may_be_hit(const Ray& ray, const FourTriangles& four) {
    unsigned lanes = 0;
    for (unsigned lane = 0; lane < 4; ++lane) {
        const auto corner = [&](const auto& p) {
            return Vector3(p[0][lane], p[1][lane], p[2][lane]);
        };
        const Vector3 a = corner(four.a), d = ray.direction;
        const Vector3 e1 = corner(four.b) - a, e2 = corner(four.c) - a, s = ray.origin - a;
        const Vector3 p = glm::cross(d, e2), q = glm::cross(s, e1);
        const float det = glm::dot(p, e1), u = glm::dot(p, s), v = glm::dot(q, d);
        const float bound = 1e-4f * std::abs(det);
        const bool misses = outside(u, det) > bound || outside(v, det - u) > bound;
        lanes |= unsigned{!misses} << lane;
    }
    return lanes;
}

}  // namespace space
