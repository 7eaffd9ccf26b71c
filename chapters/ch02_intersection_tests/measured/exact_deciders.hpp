/// @file
/// Does a ray hit a closed box, or a sphere's surface, in exact arithmetic on the float inputs? The
/// truth that this chapter's tests are counted against; by expansions alone, since nobody waits for
/// it.
#pragma once

#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch02_intersection_tests/expansion.hpp"
#include "chapters/ch02_intersection_tests/spheres.hpp"

namespace space::ch02 {

/// A number as the fraction top / bottom, bottom > 0; an end of a slab: (box - origin) / direction.
struct ExactFraction {
    Expansion<2> top;
    double bottom;
};
inline bool operator<(const ExactFraction& a, const ExactFraction& b) {
    return (a.top * b.bottom - b.top * a.bottom).sign() < 0;
}

/// The closed box and the closed interval have a common t.
inline bool exactly_hits(const Ray& ray, const Aabb& box) {
    if (!is_valid(ray) || ray.tmin == infinity || ray.tmax == -infinity || box.is_empty())
        return false;
    const auto number = [](float x) { return ExactFraction{difference(x, 0.0f), 1.0}; };
    // An infinite end bounds nothing.
    std::optional<ExactFraction> enter, leave;
    if (std::isfinite(ray.tmin)) enter = number(ray.tmin);
    if (std::isfinite(ray.tmax)) leave = number(ray.tmax);
    for (int axis = 0; axis < 3; ++axis) {
        const double d = ray.direction[axis];
        if (d == 0.0) {
            if (ray.origin[axis] < box.min[axis] || ray.origin[axis] > box.max[axis]) return false;
            continue;
        }
        const auto slab_end = [&](float end) {
            const Expansion<2> top = difference(end, ray.origin[axis]);
            return ExactFraction{d < 0.0 ? -top : top, std::abs(d)};
        };
        const ExactFraction near = slab_end((d < 0.0 ? box.max : box.min)[axis]);
        const ExactFraction far = slab_end((d < 0.0 ? box.min : box.max)[axis]);
        if (!enter || *enter < near) enter = near;
        if (!leave || far < *leave) leave = far;
    }
    return !(*leave < *enter);
}

/// A t^2 + 2 B t + C = 0 at the sphere's surface, all three exact.
struct ExactQuadratic {
    Expansion<6> a;
    Expansion<12> b;
    Expansion<26> c;
    Expansion<600> discriminant;  ///< B^2 - A C

    ExactQuadratic(const Ray& ray, const Sphere& sphere) {
        const Vector3& d = ray.direction;
        const Expansion<2> fx = difference(ray.origin.x, sphere.centre.x),
                           fy = difference(ray.origin.y, sphere.centre.y),
                           fz = difference(ray.origin.z, sphere.centre.z);
        const auto square = [](float x) {
            Expansion<1> one;
            one.push(x);
            return one * double{x};
        };
        a = square(d.x) + square(d.y) + square(d.z);
        b = fx * double{d.x} + fy * double{d.y} + fz * double{d.z};
        c = fx * fx + fy * fy + fz * fz - square(sphere.radius);
        discriminant = b * b - a * c;
    }
};

/// The surface has a point at t >= 0: both roots are real, and the larger is not negative.
inline bool exactly_hits_ahead(const ExactQuadratic& q) {
    return q.discriminant.sign() >= 0 && (q.c.sign() <= 0 || q.b.sign() <= 0);
}
/// The first t >= 0 of the surface, to within a few roundings of double; of two roots with a small
/// one, that by C / q.
inline double exact_first_t(const ExactQuadratic& q) {
    const double a = q.a.value(), b = q.b.value(), c = q.c.value(),
                 root = std::sqrt(std::max(0.0, q.discriminant.value()));
    const double sum = -b - std::copysign(root, b);
    if (sum == 0.0) return 0.0;
    const double t0 = std::min(sum / a, c / sum), t1 = std::max(sum / a, c / sum);
    return q.c.sign() <= 0 && t0 < 0.0 ? t1 : t0;
}

}  // namespace space::ch02
