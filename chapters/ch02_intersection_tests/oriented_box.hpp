/// @file
/// Ray against an oriented box: the inverse-transformed ray against the local, axis-aligned box
/// (Optim25, section 3). t is the same in both spaces as long as the direction is not normalised.
#pragma once

#include "chapters/ch02_intersection_tests/boxes.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <optional>

namespace space {

/// The points centre + axes p for p in [-half, half]; the axes are orthonormal columns.
struct OrientedBox {
    Point3 centre{0.0f};
    glm::mat3 axes{1.0f};
    Vector3 half{0.0f};
};

/// The transpose of a rotation is its inverse (Optim25, section 3.1).
inline Ray local_ray(const Ray& ray, const OrientedBox& box) {
    const glm::mat3 inverse = glm::transpose(box.axes);
    return {inverse * (ray.origin - box.centre), inverse * ray.direction, ray.tmin, ray.tmax};
}

inline std::optional<Interval> intersect(const Ray& ray, const OrientedBox& box) {
    return SlabSafe::intersect(local_ray(ray, box), Aabb{-box.half, box.half});
}

/// The axis-aligned box around it (Arvo 1990): each axis adds the size of its part.
inline Aabb bounds(const OrientedBox& box) {
    const Vector3 reach = glm::abs(box.axes[0]) * box.half.x + glm::abs(box.axes[1]) * box.half.y +
                          glm::abs(box.axes[2]) * box.half.z;
    return {box.centre - reach, box.centre + reach};
}

}  // namespace space
