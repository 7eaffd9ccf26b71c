/// @file
/// Exercise 10.5: A filter for four lanes
/// Difficulty 3 of 3, about 60 minutes.
///
/// A leaf holds four triangles, component by component, so that one SIMD instruction does the same
/// for all four. Exact arithmetic is too slow to be asked about each, and floats are not always
/// right; but a **filter** need not be right, it need only know when it is. Say which lanes may be
/// hit, one bit each: a lane's bit is 0 only if the ray's line misses the closed triangle in exact
/// arithmetic. All others go to the exact test.
///
/// Do it in floats alone: twice as many fit into a register as doubles. The stub's loop has no
/// branches that depend on a lane, so a compiler can make SIMD of it; its signs are right for
/// nearly all rays, and wrong for some that meet an edge or a vertex. What is missing is a bound on
/// its error: chapter 2 derives one for doubles (`FilteredExact::outside_bound`), of which the stub
/// has the form. Which of its numbers change?
///
/// All coordinates are 0 or between 2^-20 and 2^20 in size, so nothing overflows, and what
/// underflows is far below the bound. The check counts: lost hits, of which there must be none, on
/// rays aimed at edges and vertices; and lanes that are left, though they miss, of which there may
/// be one or two in 1,000. Whether a hit lies within the ray's interval is the exact test's to say.
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
        // TODO: what is the error of these?
        const bool misses = outside(u, det) > 0.0f || outside(v, det - u) > 0.0f;
        lanes |= unsigned{!misses} << lane;
    }
    return lanes;
}

}  // namespace space
