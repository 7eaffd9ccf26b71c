/// @file
/// Exercise 1.2, a near miss: the ray keeps away from both of its ends by an epsilon, so that light
/// shines through what touches the point or the lamp.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "common/scene.hpp"

#include <span>

namespace space {

inline bool light_reaches(const Point3& origin, const PointLight& light,
                          std::span<const Triangle> triangles) {
    const Ray shadow{.origin = origin,
                     .direction = light.position - origin,
                     .tmin = 1e-4f,
                     .tmax = 1.0f - 1e-4f};
    for (const Triangle& triangle : triangles)
        if (MollerTrumbore::intersect(shadow, triangle)) return false;
    return true;
}

}  // namespace space
