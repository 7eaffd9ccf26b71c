/// @file
/// Ray-plane: a plane in any direction needs two dot products and a division, one across an axis a
/// difference and a division.
#pragma once

#include "common/geometry.hpp"

#include <optional>

namespace space {

/// The points p with normal . p = offset.
struct Plane {
    Vector3 normal;
    float offset;
};

/// The points whose coordinate `axis` is `position`: all that a k-d tree stores.
struct AxisPlane {
    int axis;
    float position;
};

/// t where the ray's line meets the plane; infinite or not a number where it is parallel.
/// Heinonen16, section 3.1.1: t = -n . (O - Q) / (n . D).
inline float plane_t(const Ray& ray, const Plane& plane) {
    return (plane.offset - glm::dot(plane.normal, ray.origin)) /
           glm::dot(plane.normal, ray.direction);
}
inline float plane_t(const Ray& ray, const AxisPlane& plane) {
    return (plane.position - ray.origin[plane.axis]) / ray.direction[plane.axis];
}

}  // namespace space
