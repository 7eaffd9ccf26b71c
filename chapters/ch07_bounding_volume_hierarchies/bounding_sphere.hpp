/// @file
/// Spheres around points: Ritter's, which is quick, and the smallest one.
#pragma once

#include "chapters/ch04_kd_trees/clipped_bounds.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bounding_volume.hpp"
#include "common/geometry.hpp"
#include "common/pcg32.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// The points at most `radius` from the centre; a circle's in the plane. Empty at first.
template <int D>
struct BoundingSphere {
    Point<D> centre{0.0f};
    float radius = -1.0f;

    bool is_empty() const { return radius < 0.0f; }
    bool operator==(const BoundingSphere&) const = default;
};

template <int D>
double surface(const BoundingSphere<D>& sphere) {
    const double r = sphere.is_empty() ? 0.0 : double{sphere.radius};
    return std::numbers::pi * (D == 2 ? 2.0 * r : 4.0 * r * r);
}
template <int D>
double content(const BoundingSphere<D>& sphere) {
    const double r = sphere.is_empty() ? 0.0 : double{sphere.radius};
    return std::numbers::pi * r * r * (D == 2 ? 1.0 : 4.0 / 3.0 * r);
}

// ---- that it contains all ---------------------------------------------------------------------

// [reach]
/// A radius about the centre that reaches all of the sphere; nothing is added where the centres
/// are one.
///
/// With u53 = 2^-53, the computed distance is at least (1 - u53)^3.5 of the exact one: its square
/// carries a rounding of each difference, which counts twice, one of each product and two of the
/// sum, and the root halves these five and adds its own. The sum and the product below round once
/// each; 8 u53 is more than these 5.5.
template <int D>
float reach(const Point<D>& centre, const BoundingSphere<D>& sphere) {
    const double distance = glm::length(Double<D>(sphere.centre) - Double<D>(centre));
    if (distance == 0.0) return sphere.radius;
    return float_above((distance + sphere.radius) * (1.0 + 8.0 * 0x1p-53));
}

/// About any centre, around all of the points.
template <int D>
BoundingSphere<D> sphere_about(const Point<D>& centre, std::span<const Point<D>> points) {
    BoundingSphere<D> sphere{.centre = centre};
    for (const Point<D>& p : points)
        sphere.radius = std::max(sphere.radius, reach<D>(centre, {p, 0.0f}));
    return sphere;
}
// [reach]

// [merged_spheres]
/// The smallest sphere around two, but for roundings: from the far end of one to that of the other.
template <int D>
BoundingSphere<D> merged(const BoundingSphere<D>& a, const BoundingSphere<D>& b) {
    if (a.is_empty() || (!b.is_empty() && reach(b.centre, a) <= b.radius)) return b;
    if (b.is_empty() || reach(a.centre, b) <= a.radius) return a;
    const Double<D> way = Double<D>(b.centre) - Double<D>(a.centre);
    const double distance = glm::length(way);
    const double radius = 0.5 * (a.radius + distance + b.radius);
    const Point<D> centre(Double<D>(a.centre) + (radius - a.radius) / distance * way);
    return {centre, std::max(reach(centre, a), reach(centre, b))};
}
// [merged_spheres]

// ---- around points ----------------------------------------------------------------------------

// [ritter]
/// Begins with the two points that are farthest apart among the extreme ones of each axis, and
/// grows towards each point that is outside, away from the far end (Ritter 1990). Two passes, and
/// a third for the radius.
template <int D>
BoundingSphere<D> ritter_sphere(std::span<const Point<D>> points) {
    if (points.empty()) return {};
    Double<D> centre(points[0]);
    double radius = 0.0;
    for (int axis = 0; axis < D; ++axis) {
        const auto along = [axis](const Point<D>& p) { return p[axis]; };
        const auto ends = std::ranges::minmax_element(points, {}, along);
        const Double<D> low(*ends.min), high(*ends.max);
        const double half = 0.5 * glm::length(high - low);
        if (half > radius) {
            centre = 0.5 * (low + high);
            radius = half;
        }
    }
    for (const Point<D>& p : points) {
        const Double<D> way = Double<D>(p) - centre;
        const double distance = glm::length(way);
        if (distance <= radius) continue;
        centre += 0.5 * (distance - radius) / distance * way;
        radius = 0.5 * (distance + radius);
    }
    return sphere_about<D>(Point<D>(centre), points);
}
// [ritter]

/// The smallest sphere with some points on its boundary, at most D + 1 of them.
template <int D>
struct BoundarySphere {
    Double<D> centre{0.0};
    double square = -1.0;  ///< of the radius
    int count = 0;         ///< points on the boundary
    Double<D> first{0.0};
    std::array<Double<D>, D> across{};  ///< from the first one to the others, made orthogonal

    /// By more than a 64th of a float's rounding: less than that is lost in the answer, and twice
    /// as many digits of double are left to tell what is on the boundary.
    bool excludes(const Double<D>& p) const {
        const Double<D> way = p - centre;
        return glm::dot(way, way) > square * (1.0 + 0x1p-29);
    }

    // [one_more]
    /// With p on the boundary, too. The centre moves at right angles to all that are there before,
    /// along q, until p is as far as they are: |p - c - s q|^2 = r^2 + s^2 |q|^2, and q (p - c) is
    /// |q|^2 + q (first - c) = |q|^2.
    BoundarySphere with(const Double<D>& p) const {
        BoundarySphere more = *this;
        if (count == 0) {
            more.first = more.centre = p;
            more.square = 0.0;
        } else {
            Double<D> q = p - first;
            for (std::size_t i = 0; i + 1 < std::size_t(count); ++i)
                q -= glm::dot(across[i], q) / glm::dot(across[i], across[i]) * across[i];
            const double height = glm::dot(q, q);
            if (!(height > 0.0)) return more;  // it depends on the others
            const double excess = glm::dot(p - centre, p - centre) - square;
            more.centre += 0.5 * excess / height * q;
            more.square = glm::dot(more.centre - first, more.centre - first);
            more.across[std::size_t(count) - 1] = q;
        }
        ++more.count;
        return more;
    }
    // [one_more]
};

// [welzl]
/// The smallest sphere around the points that has those of `boundary` on its boundary (Welzl 1991,
/// with his moves to the front). A point outside of the smallest sphere around those before it is
/// on the boundary of the smallest one around them and itself. No deeper than D + 1 calls.
template <int D>
BoundarySphere<D> smallest_around(std::span<Double<D>> points, const BoundarySphere<D>& boundary) {
    BoundarySphere<D> sphere = boundary;
    if (boundary.count == D + 1) return sphere;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!sphere.excludes(points[i])) continue;
        sphere = smallest_around<D>(points.first(i), boundary.with(points[i]));
        std::rotate(points.begin(), points.begin() + std::ptrdiff_t(i),
                    points.begin() + std::ptrdiff_t(i) + 1);
    }
    return sphere;
}

/// The smallest sphere but for roundings, in expected linear time: the points come in random order,
/// the same for the same points. The centre is rounded to floats, and only then the radius is
/// found, so it contains all of them, whatever was rounded before.
template <int D>
BoundingSphere<D> smallest_sphere(std::span<const Point<D>> points) {
    std::vector<Double<D>> shuffled(points.begin(), points.end());
    Pcg32 random(1991);
    for (std::size_t i = shuffled.size(); i > 1; --i)
        std::swap(shuffled[i - 1], shuffled[random.below(static_cast<std::uint32_t>(i))]);
    const BoundarySphere<D> sphere = smallest_around<D>(shuffled, {});
    const BoundingSphere<D> smallest = sphere_about<D>(Point<D>(sphere.centre), points),
                            simple = ritter_sphere<D>(points);
    // A boundary whose points nearly depend on each other can spoil the centre.
    return smallest.radius <= simple.radius ? smallest : simple;
}
// [welzl]

// ---- rays -------------------------------------------------------------------------------------

/// What the test needs of a ray, once for all spheres.
template <int D>
struct SphereRay {
    Double<D> origin, direction;
    double inverse_square;  ///< 1 / (direction . direction)
    double tmin, tmax;

    explicit SphereRay(const BasicRay<D>& ray)
        : origin(ray.origin),
          direction(ray.direction),
          inverse_square(1.0 / glm::dot(direction, direction)),
          tmin(ray.tmin),
          tmax(ray.tmax) {}
};
template <int D>
SphereRay<D> prepared_for(const BasicRay<D>& ray, const BoundingSphere<D>&) {
    return SphereRay<D>(ray);
}

// [meets_sphere]
/// Whether the ray's nearest point is in the sphere; never a wrong no.
///
/// With f = origin - centre, d the direction and u53 = 2^-53: t carries eight roundings of terms
/// whose sizes sum to |f| / |d| (of f, of the products and two sums above; below, of two sums, the
/// reciprocal and the last product), and a t that is off by e is off by e |d| along the ray, within
/// its interval. f, the product t d and their sum are off by u53 |f|, u53 (|f| + r) and u53 r. The
/// last dot product and `far`, squared, count by halves: 1.5 u53 r and 0.5 u53 r; `far` itself adds
/// u53 r. In all 10 u53 |f| + 5 u53 r and terms with u53^2; 16 u53 of both is more.
template <int D>
bool meets(const SphereRay<D>& ray, const BoundingSphere<D>& sphere) {
    const Double<D> f = ray.origin - Double<D>(sphere.centre);
    const double t =
        std::clamp(-glm::dot(f, ray.direction) * ray.inverse_square, ray.tmin, ray.tmax);
    const Double<D> nearest = f + t * ray.direction;
    double size = sphere.radius;
    for (int axis = 0; axis < D; ++axis) size += std::abs(f[axis]);
    const double far = sphere.radius + 16.0 * 0x1p-53 * size;
    return !sphere.is_empty() && glm::dot(nearest, nearest) <= far * far;
}
// [meets_sphere]

}  // namespace space
