/// @file
/// How much light goes from here to there, in closed form: to a point below a polygon, and from one
/// rectangle to another. No ray, no sample: what chapter 11's estimators are held against.
#pragma once

#include "common/geometry.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace space {

/// The part of a polygon that a surface at `point` sees above its horizon (Sutherland & Hodgman
/// 1974, one plane), as vectors from the point.
inline std::vector<Double3> above_horizon(const Double3& point, const Double3& normal,
                                          std::span<const Double3> corners) {
    std::vector<Double3> seen;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Double3 a = corners[i] - point, b = corners[(i + 1) % corners.size()] - point;
        const double height_a = glm::dot(a, normal), height_b = glm::dot(b, normal);
        if (height_a >= 0.0) seen.push_back(a);
        if ((height_a < 0.0) != (height_b < 0.0))
            seen.push_back(a + (b - a) * (height_a / (height_a - height_b)));
    }
    return seen;
}

/// The irradiance at `point`, whose surface looks along the unit vector `normal`, below a polygon
/// that sends out radiance 1 from its front, where its corners run counter-clockwise: from 0 to pi,
/// and 0 behind the polygon. The point is not on the polygon's edges.
///
/// Lambert 1760: half the sum, over the edges, of the angle under which the edge is seen times the
/// cosine between `normal` and the plane through edge and point. The terms of a polygon of size s
/// at distance d are as large as s / d and their sum as s^2 / d^2: of 53 bits log2(d / s) are lost.
inline double polygon_irradiance(const Double3& point, const Double3& normal,
                                 std::span<const Double3> corners) {
    const std::vector<Double3> seen = above_horizon(point, normal, corners);
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const Double3 &a = seen[i], &b = seen[(i + 1) % seen.size()];
        const Double3 across = glm::cross(b, a);  // seen from its front the polygon runs clockwise
        const double length = glm::length(across);
        if (length > 0.0)
            sum += std::atan2(length, glm::dot(a, b)) * glm::dot(across, normal) / length;
    }
    return std::max(0.0, sum / 2.0);
}

/// A rectangle whose two edges run along two axes, up or down. Its front is where cross(u, v)
/// points.
struct Rectangle {
    Double3 corner, u, v;

    std::array<Double3, 4> corners() const {
        return {corner, corner + u, corner + u + v, corner + v};
    }
    double area() const { return glm::length(u) * glm::length(v); }
};

/// K'' = log(sqrt(a^2 + u^2)) but for a constant: a^2 and u are where two parallel edges are from
/// each other, across and along.
inline double edge_kernel(double a2, double u) {
    const double r2 = a2 + u * u, a = std::sqrt(a2);
    return r2 == 0.0 ? 0.0 : a * u * std::atan2(u, a) - (a2 - u * u) * std::log(r2) / 4.0;
}

/// The area of `from` times the share of its light that comes to `to`, which is the same the other
/// way round. Both fronts see the whole of the other; they may share an edge.
///
/// By Stokes' theorem that is 1 / (2 pi) times the integral of log(r) dp . dq over both outlines
/// (Sparrow 1963). Of edges at right angles the product is 0; of parallel ones the integral has a
/// closed form, four values of K, whose constants cancel over closed outlines. So one loop serves
/// parallel and perpendicular rectangles. For patches of size h at distance d values like d^2
/// cancel to h^4 / d^2: the relative error is some (d / h)^4 roundings.
inline double exchange_area(const Rectangle& from, const Rectangle& to) {
    const std::array<Double3, 4> p = from.corners(), q = to.corners();
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            for (int axis = 0; axis < 3; ++axis) {
                const Double3 &p0 = p[i], &p1 = p[(i + 1) % 4], &q0 = q[j], &q1 = q[(j + 1) % 4];
                if (p0[axis] == p1[axis] || q0[axis] == q1[axis]) continue;
                Double3 apart = p0 - q0;
                apart[axis] = 0.0;
                const double a2 = glm::dot(apart, apart);
                sum += edge_kernel(a2, p1[axis] - q0[axis]) + edge_kernel(a2, p0[axis] - q1[axis]) -
                       edge_kernel(a2, p1[axis] - q1[axis]) - edge_kernel(a2, p0[axis] - q0[axis]);
            }
    return sum / (2.0 * std::numbers::pi);
}

/// The share of `from`'s light that comes to `to`: from 0 to 1.
inline double form_factor(const Rectangle& from, const Rectangle& to) {
    return exchange_area(from, to) / from.area();
}

}  // namespace space
