/// @file
/// Where light is reflected: a hit point with what sampling needs to know of it, and the rays that
/// leave it without meeting the triangles that they start and end on.
#pragma once

#include "chapters/ch01_naive_ray_tracing/shading.hpp"  // hit_point, shadow_origin
#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "common/accelerator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace space {

/// A point of a triangle, seen from one side.
struct SurfacePoint {
    Double3 position;  ///< in the triangle's plane
    Double3 normal;    ///< of length 1, on the side that the ray came from
    Point3 origin;     ///< where rays leave on that side: what is gathered here, is gathered there
    std::uint32_t triangle;
    bool front;  ///< whether that side is the triangle's front
};

inline SurfacePoint surface_point(const LitScene& lit, const Ray& ray, const Hit& hit) {
    const Triangle& triangle = lit.triangles[hit.triangle];
    const Double3 position = hit_point(triangle, hit), n = normal_towards(triangle, ray);
    return {.position = position,
            .normal = n,
            .origin = shadow_origin(triangle, position, n),
            .triangle = hit.triangle,
            .front = seen_from_front(triangle, ray)};
}

/// The ray that leaves a surface in this direction.
inline Ray ray_from(const SurfacePoint& surface, const Double3& direction) {
    return {.origin = surface.origin, .direction = Vector3(direction)};
}

/// The ray that a mirror makes of `ray`.
inline Ray mirror_ray(const SurfacePoint& surface, const Ray& ray) {
    return ray_from(surface, mirrored(glm::normalize(Double3(ray.direction)), surface.normal));
}

// [ray_to_light]
/// From a surface's origin to a point P of a light, on whose front side (normal n, of any length)
/// the origin is. The ray ends on that side of the light's plane, so that the light does not stand
/// in its own way.
///
/// With m the light's largest coordinate and D the longest component from the origin to P, P is
/// moved by 2 u24 (m + D) in each coordinate, in the direction of n's. Rounding its end to float
/// takes back at most u24 (m + that offset), rounding the direction at most u24 (D + that offset):
///     n . (end - P) >= sum |n_i| u24 (2 (m + D) - (m + D) (1 + 4 u24)) > 0.99 u24 (m + D) |n|,
/// which the ray-triangle test resolves (see shadow_origin). The ray meets the light's plane at an
/// exact t > 1, which becomes a float t >= 1: above tmax, the float before 1. The offset of
/// shadow_origin alone, without D, is too small for lights that are smaller and nearer to the
/// world's origin than their distance from the surface. (Where 2^-150 is more than u24 (m + D), it
/// stands for that: an end is rounded by no more, and a direction not at all.)
inline Ray ray_to_light(const Point3& origin, const Triangle& light, const Double3& point,
                        const Double3& n) {
    const Aabb box = bounds(light);
    const Point3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
    const Double3 way = glm::abs(point - Double3(origin));
    const double reach =
        std::max({largest.x, largest.y, largest.z}) + std::max({way.x, way.y, way.z});
    const Point3 end(point + 2.0 * float_rounding(reach) * glm::sign(n));
    return {.origin = origin,
            .direction = end - origin,
            .tmin = 0.0f,
            .tmax = std::nextafter(1.0f, 0.0f)};
}
// [ray_to_light]

}  // namespace space
