/// @file
/// Exercise 10.5, our answer.
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
inline float one_norm(const Vector3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// A bit for each lane, of lane 0 the lowest.
///
/// The bound is chapter 2's, with 2^-24 for 2^-53: the same roundings, of the same sums. 9 of them
/// are counted there; the tenth is more than the terms of second order and the rounding of the
/// bound take, here too: together less than 200 * 2^-24 of one.
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
        const float n1 = one_norm(e1), n2 = one_norm(e2);
        const float bound = 10.0f * 0x1p-24f * one_norm(d) * (n1 * n2 + (n1 + n2) * one_norm(s));
        const bool misses = outside(u, det) > bound || outside(v, det - u) > bound;
        lanes |= unsigned{!misses} << lane;
    }
    return lanes;
}

}  // namespace space
