/// @file
/// Exercise 1.2: The missing occlusion test
/// Difficulty 1 of 3, about 15 minutes.
///
/// Algorithm 1 of Heinonen16 forms a shadow ray for each light and never asks what it hits, so that
/// nothing throws a shadow. Finish the function: does the light reach the point `origin`, or does a
/// triangle stand between? The point is a shadow origin (see `shadow_origin` in shading.hpp): a ray
/// that starts there may use `tmin = 0`.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "common/scene.hpp"

#include <span>

namespace space {

inline bool light_reaches(const Point3& origin, const PointLight& light,
                          std::span<const Triangle> triangles) {
    // TODO: shoot a ray from the origin to the light; only what stands *between* them keeps the
    // light away
    static_cast<void>(origin);
    static_cast<void>(light);
    static_cast<void>(triangles);
    return true;
}

}  // namespace space
