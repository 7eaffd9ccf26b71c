/// @file
/// The planes (D = 3) and lines (D = 2) that a BSP tree splits by, and on which side of them a
/// point lies.
#pragma once

#include "common/geometry.hpp"

#include <cmath>
#include <cstdint>
#include <optional>

namespace space {

/// Half the distance from 1 to the next double: the largest relative error of one rounding.
inline constexpr double double_roundoff = 0x1p-53;
/// What a product of three factors may change on its way into a sum, as a part of it: twice the
/// eight roundings that along_normal counts.
inline constexpr double sum_roundings = 16.0 * double_roundoff;

/// |v|_1.
template <int D>
double one_norm(const Double<D>& v) {
    double sum = 0.0;
    for (int axis = 0; axis < D; ++axis) sum += std::abs(v[axis]);
    return sum;
}

/// The plane through D points. Its front is the side that the normal points to: (b - a) x (c - a)
/// in space, to the left of a -> b in the plane. Normal and distances are computed in double and
/// not normalised.
template <int D>
struct SplitPlane {
    Simplex<D> through;
    Double<D> normal;
    double size;    ///< |normal|_1 <= size, and so are the sums of the products that make it up
    double length;  ///< of the normal
    Vector<D> unit;

    explicit SplitPlane(const Simplex<D>& points) : through(points) {
        const Double<D> a{points[0]}, ab = Double<D>(points[1]) - a;
        if constexpr (D == 3) {
            const Double<D> ac = Double<D>(points[2]) - a;
            normal = glm::cross(ab, ac);
            size = one_norm<D>(ab) * one_norm<D>(ac);
        } else {
            normal = {-ab.y, ab.x};
            size = one_norm<D>(ab);
        }
        length = glm::length(normal);
        unit = Vector<D>(normal / length);
    }

    /// Signed distance times |normal|; 0 on the plane.
    double distance(const Double<D>& p) const {
        return glm::dot(normal, p - Double<D>(through[0]));
    }
};

/// The plane across `axis` at `position`: one that no polygon need lie in. Its front is the larger
/// coordinate.
template <int D>
SplitPlane<D> axis_plane(int axis, float position) {
    Point<D> a(0.0f);
    a[axis] = position;
    if constexpr (D == 3) {
        Point<D> b = a, c = a;
        b[(axis + 1) % 3] = c[(axis + 2) % 3] = 1.0f;
        return SplitPlane<D>({a, b, c});
    } else {
        Point<D> b = a;
        b[1 - axis] = axis == 0 ? -1.0f : 1.0f;
        return SplitPlane<D>({a, b});
    }
}

/// A computed number, and how far off it may be.
struct Estimate {
    double value, error;
};

// [side_filter]
/// normal . v, where v is known but for one rounding of each coordinate. A term of the sum carries
/// at most eight roundings: of two differences, their product and a sum in the normal, of v, of the
/// product with it, and of two sums. sum_roundings are twice as many: half of the error is spare.
template <int D>
Estimate along_normal(const SplitPlane<D>& plane, const Double<D>& v) {
    return {glm::dot(plane.normal, v), sum_roundings * plane.size * one_norm<D>(v)};
}

/// The side of a point known to within `off` in every coordinate: 1 in front, -1 behind, nothing
/// where double cannot tell.
template <int D>
std::optional<int> side_filter(const SplitPlane<D>& plane, const Double<D>& p, double off) {
    const Estimate distance = along_normal(plane, p - Double<D>(plane.through[0]));
    const double bound = distance.error + 2.0 * plane.size * off;
    if (distance.value > bound) return 1;
    if (distance.value < -bound) return -1;
    return std::nullopt;
}
// [side_filter]

}  // namespace space
