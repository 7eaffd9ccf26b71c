/// @file
/// A ray on its way into an object's local space, and there against the boxes of the object's tree:
/// with margins that are derived, and cost nothing at a box.
#pragma once

#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_ray.hpp"
#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

namespace space {

// [local_ray]
/// The ray in the space of an object: origin + t direction, in double, with the t of the world; the
/// direction is not made to have length 1. What it hits in the flattened mesh, at t, lies in local
/// space within `margin` of this point, by axis.
///
/// The flattened triangle's corners are M v, rounded; M is the product along the path, v the
/// mesh's. A point of it, p = origin + t direction in the world, is the same mean of these that
/// some point q of the local triangle is of the v. So p = M q + e, where e is at most what
/// flattening rounds: the world_margin of the first instance on the path (each coordinate's half
/// place as a float, and the roundings in double). With N, which is nearly the inverse of M, R = N
/// M - 1 and linear parts alone for differences,
///
///     q = N p - R q - N e = (N origin + t N direction) - R q - N e.
///
/// Level by level, from a group's space into that of one of its instances, the margin so becomes
/// |N| margin + |R| reach, and what N origin and t N direction are rounded by: at most four
/// roundings in a coordinate, 4 u53 |N| (|origin| + t |direction|) with u53 = 2^-53, the part of
/// N's translation being in the instance's local_margin. Six instead of four, and 2^-48 of it all,
/// are more than the roundings of the margin itself and of what follows. t is at most `farthest`.
struct LocalRay {
    Double3 origin, direction;
    Double3 margin{0.0};
    double farthest = infinity;  ///< above |t| of all points in the scene's box

    /// In the world, where nothing is rounded.
    LocalRay(const Ray& ray, const Aabb& scene) : origin(ray.origin), direction(ray.direction) {
        for (int axis = 0; axis < 3; ++axis) {
            const double reach =
                std::max(std::abs(double{scene.min[axis]}), std::abs(double{scene.max[axis]})) +
                std::abs(origin[axis]);
            if (direction[axis] != 0.0)
                farthest = std::min(farthest, reach / std::abs(direction[axis]));
        }
        farthest *= 1.0 + 0x1p-50;
    }

    /// In the space of an instance of the group in whose space it is with this margin.
    LocalRay within(const PlacedInstance& instance, const Double3& margin_there) const {
        LocalRay local = *this;
        local.origin = instance.to_local.point(origin);
        local.direction = instance.to_local.vector(direction);
        const Double3 rounded = glm::abs(origin) + farthest * glm::abs(direction);
        local.margin = instance.to_local.size_of_vector(margin_there + 6.0 * 0x1p-53 * rounded) +
                       instance.local_margin;
        local.margin *= 1.0 + 0x1p-48;
        return local;
    }
};
// [local_ray]

// [instanced_ray]
/// A local ray against boxes, in float. Chapter 7's test as it is, but that near planes are seen
/// from an origin that is moved forward by the margin, and far planes from one moved back: so all
/// planes are moved outwards.
///
/// Where direction[axis] > 0 a point q of the box at t has min <= q <= origin + margin + t
/// direction, so t >= (min - (origin + margin)) / direction: SlabConservative's proof goes on from
/// there. (The reciprocal is shortened in double and then rounded once, which is no more than its
/// four roundings.) Rounding the origins takes half a place, which is added before.
class InstancedRay {
  public:
    using Real = float;

    InstancedRay(const LocalRay& ray, float tmin, float limit,
                 BoxMargins margins = BoxMargins::conservative)
        : tmin_(tmin), limit_(limit) {
        const bool wide = margins == BoxMargins::conservative;
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = std::signbit(ray.direction[axis]);
            const auto lower = static_cast<std::size_t>(axis), upper = lower + 3;
            near_[lower] = (backwards ? upper : lower) * sizeof(float);
            far_[lower] = (backwards ? lower : upper) * sizeof(float);

            const double origin = ray.origin[axis], inverse = 1.0 / ray.direction[axis];
            const double margin = !wide ? 0.0 : float_margin(origin, ray.margin[axis]);
            near_origin_[axis] = static_cast<float>(origin + (backwards ? -margin : margin));
            far_origin_[axis] = static_cast<float>(origin - (backwards ? -margin : margin));
            near_inverse_[axis] =
                static_cast<float>(wide ? inverse * SlabConservative::shorten : inverse);
            far_inverse_[axis] =
                static_cast<float>(wide ? inverse * SlabConservative::lengthen : inverse);
        }
    }

    /// Whether floats do for this ray and the boxes inside of this one; as in chapter 7.
    bool is_safe(const LocalRay& ray, const Aabb& all) const {
        bool safe = tmin_ >= 0.0f;
        for (int axis = 0; axis < 3; ++axis)
            safe = safe &&
                   (ray.direction[axis] == 0.0 ||
                    (std::isnormal(near_inverse_[axis]) && std::isnormal(far_inverse_[axis]))) &&
                   std::isfinite(all.min[axis] - near_origin_[axis]) &&
                   std::isfinite(all.max[axis] - near_origin_[axis]) &&
                   std::isfinite(all.min[axis] - far_origin_[axis]) &&
                   std::isfinite(all.max[axis] - far_origin_[axis]);
        return safe;
    }

    float limit() const { return limit_; }

    BoxSpan<float> span_in(const Aabb& box, float limit) const {
        float enter = tmin_, leave = limit;
#pragma GCC unroll 3
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int i = static_cast<int>(axis);
            const float near = (plane(box, near_[axis]) - near_origin_[i]) * near_inverse_[i];
            const float far = (plane(box, far_[axis]) - far_origin_[i]) * far_inverse_[i];
            enter = near > enter ? near : enter;
            leave = far < leave ? far : leave;
        }
        return {enter, leave + SlabConservative::tiny};
    }

  private:
    /// And half a place of the sum as a float: u24 of it, or half of the smallest float.
    static double float_margin(double origin, double margin) {
        return margin + 0x1.01p-24 * (std::abs(origin) + margin) + 0x1p-149;
    }
    static float plane(const Aabb& box, std::size_t bytes) {
        static_assert(sizeof box == 6 * sizeof(float));
        float position;
        std::memcpy(&position, reinterpret_cast<const char*>(&box) + bytes, sizeof position);
        return position;
    }

    Point3 near_origin_, far_origin_;
    Vector3 near_inverse_, far_inverse_;
    std::array<std::size_t, 3> near_, far_;  ///< where planes lie in a box, in bytes
    float tmin_, limit_;
};
// [instanced_ray]

// [instanced_double_ray]
/// The same for all other rays, in double, where nothing over- or underflows that has a meaning; as
/// slow as it may be. A distance has three roundings, and eight u53 are more for both ends of a
/// part, as RayPart in chapter 4 has them. One that is not a number changes nothing. Nor does an
/// axis along which a path of matrices has taken the ray beyond the doubles: what stands there says
/// no more where it is.
class InstancedDoubleRay {
  public:
    using Real = double;

    InstancedDoubleRay(const LocalRay& ray, const Ray& world, double limit)
        : ray_(ray), part_(RayPart::all_of(world)), limit_(limit) {}

    double limit() const { return std::min(limit_, part_.leave); }

    BoxSpan<double> span_in(const Aabb& box, double limit) const {
        double enter = -infinity, leave = infinity;
        for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(ray_.origin[axis]) || !std::isfinite(ray_.direction[axis])) continue;
            const bool backwards = std::signbit(ray_.direction[axis]);
            const double margin = backwards ? -ray_.margin[axis] : ray_.margin[axis];
            const double inverse = 1.0 / ray_.direction[axis];
            const double near = backwards ? box.max[axis] : box.min[axis],
                         far = backwards ? box.min[axis] : box.max[axis];
            enter = std::max(enter, (near - (ray_.origin[axis] + margin)) * inverse);
            leave = std::min(leave, (far - (ray_.origin[axis] - margin)) * inverse);
        }
        if (leave < part_.enter || enter > part_.leave) return {1.0, 0.0};
        RayPart part = part_;
        part.begin_at(enter);
        part.end_at(leave);
        return {part.enter, std::min(limit, part.leave)};  // not a number where the limit is not
    }

  private:
    LocalRay ray_;
    RayPart part_;
    double limit_;
};
// [instanced_double_ray]

}  // namespace space
