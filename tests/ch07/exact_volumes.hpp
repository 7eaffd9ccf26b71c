/// @file
/// The chapter's volumes in rational numbers: what is in them, and which rays meet them.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bounding_sphere.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/k_dop.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/oriented_bounds.hpp"
#include "tests/exact_vector.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace space {

/// Normals and slabs: of boxes of both kinds, and of k-DOPs.
template <int D>
using ExactSlabs = std::vector<std::pair<ExactVector<D>, Slab>>;

template <int D>
ExactSlabs<D> exact_slabs(const BasicAabb<D>& box) {
    ExactSlabs<D> slabs;
    for (int axis = 0; axis < D; ++axis) {
        Vector<D> normal(0.0f);
        normal[axis] = 1.0f;
        slabs.emplace_back(exact(normal), Slab{box.min[axis], box.max[axis]});
    }
    return slabs;
}
template <int D>
ExactSlabs<D> exact_slabs(const OrientedBounds<D>& box) {
    ExactSlabs<D> slabs;
    for (std::size_t i = 0; i < D; ++i) slabs.emplace_back(exact(box.axes[i]), box.slabs[i]);
    return slabs;
}
template <int K, int D>
ExactSlabs<D> exact_slabs(const KDop<K, D>& dop) {
    ExactSlabs<D> slabs;
    for (std::size_t i = 0; i < dop.slabs.size(); ++i)
        slabs.emplace_back(exact(k_dop_normal<K, D>(i)), dop.slabs[i]);
    return slabs;
}

/// An infinite end bounds nothing.
inline bool is_above(const mpq_class& x, float low) {
    return low == -infinity || (low != infinity && x >= mpq_class(low));
}
inline bool is_in(const mpq_class& x, const Slab& slab) {
    return is_above(x, slab.low) && is_above(-x, -slab.high);
}
template <int D>
bool exactly_contains(const ExactSlabs<D>& slabs, const ExactVector<D>& p) {
    for (const auto& [normal, slab] : slabs)
        if (!is_in(dot(normal, p), slab)) return false;
    return true;
}
template <class Volume, int D>
bool exactly_contains(const Volume& volume, const Point<D>& p) {
    return exactly_contains<D>(exact_slabs(volume), exact(p));
}
template <int D>
bool exactly_contains(const BoundingSphere<D>& sphere, const Point<D>& p) {
    if (sphere.is_empty() || sphere.radius == infinity) return !sphere.is_empty();
    const ExactVector<D> way = exact(p) - exact(sphere.centre);
    return dot(way, way) <= mpq_class(sphere.radius) * mpq_class(sphere.radius);
}

/// By definition: t within [tmin, tmax] and, for each slab, low <= n . o + t n . d <= high.
template <int D>
bool exactly_meets(const BasicRay<D>& ray, const ExactSlabs<D>& slabs) {
    std::optional<mpq_class> enter, leave;
    const auto at_least = [&](const mpq_class& t) {
        if (!enter || *enter < t) enter = t;
    };
    const auto at_most = [&](const mpq_class& t) {
        if (!leave || t < *leave) leave = t;
    };
    if (std::isfinite(ray.tmin)) at_least(ray.tmin);
    if (std::isfinite(ray.tmax)) at_most(ray.tmax);
    for (const auto& [normal, slab] : slabs) {
        if (slab.is_empty()) return false;
        const mpq_class origin = dot(normal, exact(ray.origin)),
                        speed = dot(normal, exact(ray.direction));
        if (speed == 0 && !is_in(origin, slab)) return false;
        if (speed == 0) continue;
        for (const bool at_low : {true, false}) {
            const float plane = at_low ? slab.low : slab.high;
            if (!std::isfinite(plane)) continue;
            const mpq_class t = (mpq_class(plane) - origin) / speed;
            if (at_low == (speed > 0))
                at_least(t);
            else
                at_most(t);
        }
    }
    return !enter || !leave || *enter <= *leave;
}
template <class Volume, int D>
bool exactly_meets(const BasicRay<D>& ray, const Volume& volume) {
    return exactly_meets<D>(ray, exact_slabs(volume));
}

/// The square of the distance between the centre and the part of the ray that is nearest.
template <int D>
mpq_class square_of_distance(const BasicRay<D>& ray, const Point<D>& centre) {
    const ExactVector<D> f = exact(ray.origin) - exact(centre), d = exact(ray.direction);
    mpq_class t = -dot(f, d) / dot(d, d);
    if (std::isfinite(ray.tmin) && t < mpq_class(ray.tmin)) t = ray.tmin;
    if (std::isfinite(ray.tmax) && t > mpq_class(ray.tmax)) t = ray.tmax;
    ExactVector<D> nearest;
    for (int axis = 0; axis < D; ++axis) nearest[axis] = f[axis] + t * d[axis];
    return dot(nearest, nearest);
}
template <int D>
bool exactly_meets(const BasicRay<D>& ray, const BoundingSphere<D>& sphere) {
    if (sphere.is_empty() || sphere.radius == infinity) return !sphere.is_empty();
    return square_of_distance(ray, sphere.centre) <=
           mpq_class(sphere.radius) * mpq_class(sphere.radius);
}

}  // namespace space
