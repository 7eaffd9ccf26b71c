/// @file
/// A ray against the boxes of a tree: chapter 2's conservative slab test, for a walk that asks
/// about many boxes.
#pragma once

#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>

namespace space {

/// Where a ray enters and leaves a box, or passes it.
template <class Real>
struct BoxSpan {
    Real enter, leave;
    bool is_met() const { return enter <= leave; }
};

/// Whether the slab test gives its margins: without them it is as fast, and now and then misses.
enum class BoxMargins { conservative, none };

// [bvh_ray]
/// What the walk needs of a ray, once for all boxes. Never misses a box that holds a point of the
/// ray whose t, rounded to float, lies in [tmin, tmax] and before the limit; SlabConservative
/// proves it for rays that are safe.
///
/// Which of the two planes across an axis is the near one depends on the ray's direction alone. So
/// it is chosen once, by where planes lie in memory, and no box pays for it.
template <int D>
class BvhRay {
  public:
    using Real = float;

    explicit BvhRay(const BasicRay<D>& ray, BoxMargins margins = BoxMargins::conservative)
        : origin_(ray.origin),
          near_inverse_(1.0f / ray.direction),
          far_inverse_(near_inverse_),
          tmin_(ray.tmin),
          tmax_(ray.tmax) {
        for (int axis = 0; axis < D; ++axis) {
            const bool backwards = std::signbit(ray.direction[axis]);
            const auto lower = static_cast<std::size_t>(axis), upper = lower + D;
            near_[lower] = (backwards ? upper : lower) * sizeof(float);
            far_[lower] = (backwards ? lower : upper) * sizeof(float);
        }
        if (margins == BoxMargins::conservative) {
            near_inverse_ *= SlabConservative::shorten;
            far_inverse_ *= SlabConservative::lengthen;
        }
    }

    /// Whether floats do for this ray and the boxes inside of this one: t from 0 on, reciprocals
    /// that are normal numbers, no difference that overflows.
    bool is_safe(const BasicRay<D>& ray, const BasicAabb<D>& all) const {
        bool safe = ray.tmin >= 0.0f;
        for (int axis = 0; axis < D; ++axis)
            safe = safe && (ray.direction[axis] == 0.0f || std::isnormal(near_inverse_[axis])) &&
                   std::isfinite(all.min[axis] - origin_[axis]) &&
                   std::isfinite(all.max[axis] - origin_[axis]);
        return safe;
    }

    float limit() const { return tmax_; }

    /// The part of the ray in the box, up to the limit. A product that is not a number, where the
    /// ray lies in a face, loses each comparison and changes nothing.
    BoxSpan<float> span_in(const BasicAabb<D>& box, float limit) const {
        float enter = tmin_, leave = limit;
#pragma GCC unroll 3
        for (std::size_t axis = 0; axis < D; ++axis) {
            const int i = static_cast<int>(axis);
            const float near = (plane(box, near_[axis]) - origin_[i]) * near_inverse_[i];
            const float far = (plane(box, far_[axis]) - origin_[i]) * far_inverse_[i];
            enter = near > enter ? near : enter;
            leave = far < leave ? far : leave;
        }
        return {enter, leave + tiny};
    }

  private:
    static constexpr float tiny = SlabConservative::tiny;

    /// The box is its lower planes, then its upper ones.
    static float plane(const BasicAabb<D>& box, std::size_t bytes) {
        static_assert(sizeof box == 2 * D * sizeof(float));
        float position;
        std::memcpy(&position, reinterpret_cast<const char*>(&box) + bytes, sizeof position);
        return position;
    }

    Point<D> origin_;
    Vector<D> near_inverse_, far_inverse_;
    std::array<std::size_t, D> near_, far_;  ///< where planes lie in a box, in bytes
    float tmin_, tmax_;
};
// [bvh_ray]

/// The same for every other valid ray: chapter 4's test in double, as slow as it may be.
template <int D>
class BvhDoubleRay {
  public:
    using Real = double;

    explicit BvhDoubleRay(const BasicRay<D>& ray) : ray_(ray), prepared_(ray) {}

    double limit() const { return RayPart::all_of(ray_).leave; }

    BoxSpan<double> span_in(const BasicAabb<D>& box, double limit) const {
        const std::optional<RayPart> part = part_in(box, prepared_, RayPart::all_of(ray_));
        if (!part) return {1.0, 0.0};
        return {part->enter, std::min(part->leave, limit)};
    }

  private:
    BasicRay<D> ray_;
    KdRay<D> prepared_;
};

}  // namespace space
