/// @file
/// The planes (D = 3) and lines (D = 2) that a BSP tree splits by, and on which side of them a
/// point lies.
#pragma once

#include "common/geometry.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace space {

template <int D>
using DoublePoint = glm::vec<D, double>;

/// A polygon of the input: a triangle in space, a segment in the plane.
template <int D>
using Corners = std::array<Point<D>, D>;

inline Corners<3> corners(const Triangle& triangle) {
    return {triangle.a, triangle.b, triangle.c};
}
inline Corners<2> corners(const Segment& segment) {
    return {segment.a, segment.b};
}
inline std::vector<Corners<3>> corners(std::span<const Triangle> triangles) {
    std::vector<Corners<3>> all;
    for (const Triangle& triangle : triangles) all.push_back(corners(triangle));
    return all;
}
inline std::vector<Corners<2>> corners(std::span<const Segment> segments) {
    std::vector<Corners<2>> all;
    for (const Segment& segment : segments) all.push_back(corners(segment));
    return all;
}

/// The plane through D points. Its front is the side that the normal points to: (b - a) x (c - a)
/// in space, to the left of a -> b in the plane. Normal and distances are computed in double and
/// not normalised.
template <int D>
struct SplitPlane {
    Corners<D> through;
    DoublePoint<D> normal;
    double size;    ///< |normal|_1 <= size, and so are the sums of the products that make it up
    double length;  ///< of the normal
    Vector<D> unit;

    explicit SplitPlane(const Corners<D>& points) : through(points) {
        const DoublePoint<D> a{points[0]}, ab = DoublePoint<D>(points[1]) - a;
        if constexpr (D == 3) {
            const DoublePoint<D> ac = DoublePoint<D>(points[2]) - a;
            normal = glm::cross(ab, ac);
            size = one_norm(ab) * one_norm(ac);
        } else {
            normal = {-ab.y, ab.x};
            size = one_norm(ab);
        }
        length = glm::length(normal);
        unit = Vector<D>(normal / length);
    }

    static double one_norm(const DoublePoint<D>& v) {
        double sum = 0.0;
        for (int axis = 0; axis < D; ++axis) sum += std::abs(v[axis]);
        return sum;
    }
    /// Signed distance times |normal|; 0 on the plane.
    double distance(const DoublePoint<D>& p) const {
        return glm::dot(normal, p - DoublePoint<D>(through[0]));
    }
};

/// The plane across `axis` at `position`: one that no polygon need lie in. Its front is the larger
/// coordinate.
template <int D>
SplitPlane<D> axis_plane(int axis, float position) {
    Corners<D> points;
    for (auto& point : points) point = Point<D>(0.0f), point[axis] = position;
    if constexpr (D == 3) {
        points[1][(axis + 1) % 3] = 1.0f;
        points[2][(axis + 2) % 3] = 1.0f;
    } else {
        points[1][1 - axis] = axis == 0 ? -1.0f : 1.0f;
    }
    return SplitPlane<D>(points);
}

// [side_filter]
/// The side of a point known to within `error` in every coordinate: 1 in front, -1 behind, nothing
/// where double cannot tell. A term of the distance carries at most eight roundings (the
/// differences, the products and sums of the normal, the product and the sums of the dot product);
/// sixteen times u = 2^-53 covers them and the bound's own.
template <int D>
std::optional<int> side_filter(const SplitPlane<D>& plane, const DoublePoint<D>& p, double error) {
    constexpr double roundings = 16.0 * 0x1p-53;
    const DoublePoint<D> from = p - DoublePoint<D>(plane.through[0]);
    const double distance = glm::dot(plane.normal, from);
    const double bound = plane.size * (roundings * SplitPlane<D>::one_norm(from) + 2.0 * error);
    if (distance > bound) return 1;
    if (distance < -bound) return -1;
    return std::nullopt;
}
// [side_filter]

}  // namespace space
