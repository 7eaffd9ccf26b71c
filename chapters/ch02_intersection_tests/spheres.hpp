/// @file
/// Ray-sphere tests: the geometric one of Heinonen16 as printed and corrected, the schoolbook
/// quadratic, and the stable one.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace space {

/// The points at the distance radius from the centre.
struct Sphere {
    Point3 centre{0.0f};
    float radius = 1.0f;
};

/// Heinonen16, section 3.2, as printed: the distance of the centre from the ray's *line* decides,
/// so a sphere behind the origin is hit too.
struct SphereAsPrinted {
    static bool hits(const Ray& ray, const Sphere& sphere) {
        const Vector3 to_centre = sphere.centre - ray.origin;
        const float along = glm::dot(to_centre, ray.direction) / glm::length(ray.direction);
        return std::sqrt(glm::dot(to_centre, to_centre) - along * along) < sphere.radius;
    }
};

/// t of the first point of the sphere's surface in [tmin, tmax], by the quadratic A t^2 + 2 B t + C
/// = 0 as at school: B^2 - A C cancels when the sphere is small or far, and so does -B + root when
/// the origin is near the surface.
struct SphereSchoolbook {
    // [sphere_schoolbook]
    static std::optional<float> intersect(const Ray& ray, const Sphere& sphere) {
        const Vector3 f = ray.origin - sphere.centre;
        const float a = glm::dot(ray.direction, ray.direction), b = glm::dot(f, ray.direction);
        const float c = glm::dot(f, f) - sphere.radius * sphere.radius;
        const float discriminant = b * b - a * c;
        if (!(discriminant >= 0.0f)) return std::nullopt;
        const float root = std::sqrt(discriminant);
        for (const float t : {(-b - root) / a, (-b + root) / a})
            if (t >= ray.tmin && t <= ray.tmax) return t;
        return std::nullopt;
    }
    // [sphere_schoolbook]
};

/// The stable form (Haines, Günther & Akenine-Möller 2019, "Precision Improvements for Ray/Sphere
/// Intersection"): the discriminant from the vector between the centre and the ray's nearest point,
/// and the root without cancellation from the product of the two.
struct SphereStable {
    // [sphere_stable]
    static std::optional<float> intersect(const Ray& ray, const Sphere& sphere) {
        const Vector3 f = ray.origin - sphere.centre;
        const float a = glm::dot(ray.direction, ray.direction), b = -glm::dot(f, ray.direction);
        const Vector3 nearest = f + (b / a) * ray.direction;
        const float r2 = sphere.radius * sphere.radius;
        const float discriminant = r2 - glm::dot(nearest, nearest);
        if (!(discriminant >= 0.0f)) return std::nullopt;
        const float q = b + std::copysign(std::sqrt(a * discriminant), b);
        const float c = glm::dot(f, f) - r2;
        const float other = q == 0.0f ? 0.0f : c / q;  // a tangent at the origin: both roots are 0
        const float t0 = std::min(other, q / a), t1 = std::max(other, q / a);
        for (const float t : {t0, t1})
            if (t >= ray.tmin && t <= ray.tmax) return t;
        return std::nullopt;
    }
    // [sphere_stable]
};

/// The schoolbook's formula in double: nothing cancels that floats could tell apart, nearly always.
struct SphereDouble {
    static std::optional<float> intersect(const Ray& ray, const Sphere& sphere) {
        const Double3 d{ray.direction}, f = Double3(ray.origin) - Double3(sphere.centre);
        const double a = glm::dot(d, d), b = glm::dot(f, d);
        const double c = glm::dot(f, f) - double{sphere.radius} * sphere.radius;
        const double discriminant = b * b - a * c;
        if (!(discriminant >= 0.0)) return std::nullopt;
        const double root = std::sqrt(discriminant);
        const double q = -b - std::copysign(root, b);
        const double other = q == 0.0 ? 0.0 : c / q;
        const double t0 = std::min(other, q / a), t1 = std::max(other, q / a);
        for (const double root_t : {t0, t1})
            if (const auto t = static_cast<float>(root_t); t >= ray.tmin && t <= ray.tmax) return t;
        return std::nullopt;
    }
};

}  // namespace space
