/// @file
/// What light leaves a hit point towards the eye: Lambert's law, point lights, shadow rays. Both
/// renderers of this chapter shade with this function, so that their pictures differ only by what
/// each of them knows.
#pragma once

#include "common/accelerator.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace space {

/// Seen from the side that the normal points to, the vertices run counter-clockwise.
inline bool seen_from_front(const Triangle& triangle, const Ray& ray) {
    return glm::dot(normal(triangle), Double3(ray.direction)) < 0.0;
}

/// The normal of the side that the ray comes from, of length 1. Front and back are lit alike:
/// meshes from files are open, or wound either way, and a side left black would look like a shadow.
inline Double3 normal_towards(const Triangle& triangle, const Ray& ray) {
    const Double3 n = glm::normalize(normal(triangle));
    return seen_from_front(triangle, ray) ? n : -n;
}

/// The hit point from its barycentric coordinates, which keeps it in the triangle's plane: the
/// rounding of u and v moves it along the plane only. origin + t direction would lie off the plane
/// by the rounding of t.
inline Double3 hit_point(const Triangle& triangle, const Hit& hit) {
    const Double3 a{triangle.a}, b{triangle.b}, c{triangle.c};
    return a + double{hit.u} * (b - a) + double{hit.v} * (c - a);
}

/// u24, the largest relative error of rounding to float.
inline constexpr double float_roundoff = 0x1p-24;

/// How far rounding to float moves a coordinate of size m: u24 m, or half of a step where floats
/// are subnormal.
constexpr double float_rounding(double m) {
    return std::max(float_roundoff * m, 0x1p-150);
}

// [shadow_origin]
/// Where a ray may leave a triangle on the side of the normal n (either of its two normals, of any
/// length) without meeting the triangle again. The hit point P, rounded to float, lies beside the
/// plane as often as before it, and half of the shadow rays would hit the triangle that they start
/// from. So each coordinate is first moved in the direction of n's, by two roundings r of the
/// triangle's largest coordinate m: r = u24 m, and never below 2^-150. Rounding takes back at most
/// r (1 + 2 u24), where u24 = 2^-24:
///     n . (P' - P) >= sum |n_i| (2 r - r (1 + 2 u24)) > 0.99 r |n|.
/// This product is the numerator of t in the ray-triangle test, a volume of P' - a and two edges.
/// Computed in double it is off by at most 8 u53 = 2^-50 times the product of their 1-norms, each
/// up to sqrt(3) times the triangle's size L: 2^-47.6 L^3. As L <= 2 sqrt(3) m, the product is more
/// than that for every triangle but needles whose area is below 2^-22 of their length squared. The
/// bound grows with the distance from the world's origin, as the float grid does; it is no scene's
/// epsilon.
inline Point3 shadow_origin(const Triangle& triangle, const Double3& point, const Double3& n) {
    const Aabb box = bounds(triangle);
    const Point3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
    const double offset = 2.0 * float_rounding(std::max({largest.x, largest.y, largest.z}));
    return Point3(point + offset * glm::sign(n));
}
// [shadow_origin]

/// From the point to the light at t = 1, where the ray ends: what lies beyond the light casts no
/// shadow.
inline Ray shadow_ray(const Point3& origin, const PointLight& light) {
    return {.origin = origin, .direction = light.position - origin, .tmin = 0.0f, .tmax = 1.0f};
}

/// Lambert's law: a diffuse surface of reflectance c sends c / pi of what arrives in every
/// direction; from a point light arrives intensity cos(angle) / distance^2. `to_light` reaches from
/// the surface to the light, |n| = 1.
inline Color lambert(const Color& reflectance, const Color& intensity, const Double3& n,
                     const Double3& to_light) {
    const double squared_distance = glm::dot(to_light, to_light);
    const double cosine = std::max(0.0, glm::dot(n, to_light) / std::sqrt(squared_distance));
    return reflectance * intensity *
           static_cast<float>(cosine / (std::numbers::pi * squared_distance));
}

// [shade]
/// The light of all lamps that the hit point sees. `unoccluded(shadow)` says whether the light at
/// the end of the ray `shadow` is seen; it is asked only about lights on the side that the eye is
/// on.
template <class Unoccluded>
Color shade(const Scene& scene, const Ray& ray, const Hit& hit, const Unoccluded& unoccluded) {
    const Triangle triangle = scene.mesh.triangle(hit.triangle);
    const Double3 n = normal_towards(triangle, ray);
    const Point3 origin = shadow_origin(triangle, hit_point(triangle, hit), n);
    Color sum{0.0f};
    for (const PointLight& light : scene.lights) {
        const Ray shadow = shadow_ray(origin, light);
        const Double3 to_light{shadow.direction};
        if (glm::dot(n, to_light) > 0.0 && unoccluded(shadow))
            sum += lambert(scene.color(hit.triangle), light.intensity, n, to_light);
    }
    return sum;
}
// [shade]

}  // namespace space
