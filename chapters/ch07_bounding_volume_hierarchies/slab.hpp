/// @file
/// A slab: all points between two parallel planes, in any direction (Kay & Kajiya 1986). Oriented
/// boxes and k-DOPs are made of slabs.
#pragma once

#include "chapters/ch02_intersection_tests/expansion.hpp"
#include "chapters/ch04_kd_trees/clipped_bounds.hpp"
#include "common/geometry.hpp"

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace space {

/// Axes at right angles, of length 1: the columns of a matrix.
template <int D>
using Frame = glm::mat<D, D, double>;

/// Axes at right angles, the last one in the direction of w.
inline Frame<3> frame_about(const Double3& w) {
    const Double3 axis = std::abs(w.x) <= std::abs(w.y) && std::abs(w.x) <= std::abs(w.z)
                             ? Double3(1, 0, 0)
                         : std::abs(w.y) <= std::abs(w.z) ? Double3(0, 1, 0)
                                                          : Double3(0, 0, 1);
    const Double3 u = glm::normalize(glm::cross(axis, w));
    return {u, glm::normalize(glm::cross(w, u)), glm::normalize(w)};
}

// [dot_range]
/// Between these an exact dot product lies; they are one where no sum is rounded.
struct DotRange {
    double low, high;
};

/// Products of two floats are doubles. Each sum's rounding is known exactly; with u53 = 2^-53 the
/// sum of their sizes is rounded once, the widening and the last sums by u53 of what they are:
/// 8 u53 of the roundings and 2 u53 of the sum are more.
template <int D>
DotRange dot_range(const Vector<D>& n, const Vector<D>& p) {
    double sum = double{n[0]} * p[0], rounded = 0.0;
    for (int axis = 1; axis < D; ++axis) {
        const auto [high, low] = two_sum(sum, double{n[axis]} * p[axis]);
        sum = high;
        rounded += std::abs(low);
    }
    if (rounded == 0.0) return {sum, sum};
    const double off = rounded * (1.0 + 0x1p-50) + std::abs(sum) * 0x1p-52;
    return {sum - off, sum + off};
}
// [dot_range]

/// The points p with low <= n . p <= high for a normal n; none at first.
struct Slab {
    float low = infinity, high = -infinity;

    bool is_empty() const { return !(low <= high); }
    void extend(const DotRange& range) {
        low = std::min(low, float_below(range.low));
        high = std::max(high, float_above(range.high));
    }
    void extend(const Slab& slab) {
        low = std::min(low, slab.low);
        high = std::max(high, slab.high);
    }
    double width() const { return is_empty() ? 0.0 : double{high} - double{low}; }
    bool operator==(const Slab&) const = default;
};

/// A ray along a normal: all that it takes to clip it by slabs of this normal.
///
/// Origin and speed n . d are known between bounds, so each plane is met between two values of t:
/// the smaller one of the near plane and the larger one of the far plane are taken. Computed from
/// these bounds a t has three roundings, of a difference, a reciprocal and a product, and a fourth
/// from what chapter 2's box test does against them: a reciprocal shortened by 4 u53, or lengthened
/// by 6 u53, is on the safe side. Where the bounds of the speed have different signs the planes
/// may be met anywhere: such a slab clips nothing.
class SlabRay {
  public:
    SlabRay() = default;
    template <int D>
    SlabRay(const Vector<D>& normal, const BasicRay<D>& ray) {
        const DotRange origin = dot_range<D>(normal, ray.origin),
                       speed = dot_range<D>(normal, ray.direction);
        if (speed.low <= 0.0 && speed.high >= 0.0 && speed.low < speed.high) return;
        backwards_ = speed.high < 0.0;
        near_origin_ = backwards_ ? origin.low : origin.high;
        far_origin_ = backwards_ ? origin.high : origin.low;
        // A sum with 0 has no sign where it is 0: 1 / 0 is then infinity, not minus infinity.
        const double slow = (backwards_ ? speed.high : speed.low) + 0.0,
                     fast = (backwards_ ? speed.low : speed.high) + 0.0;
        soonest_ = 1.0 / fast * (1.0 - 4.0 * 0x1p-53);
        latest_ = 1.0 / slow * (1.0 + 6.0 * 0x1p-53);
    }

    // [clip_slab]
    /// Shortens the part of the ray from `enter` to `leave` to what may be in the slab.
    void clip(const Slab& slab, double& enter, double& leave) const {
        const double near = (backwards_ ? slab.high : slab.low) - near_origin_,
                     far = (backwards_ ? slab.low : slab.high) - far_origin_;
        const double first = std::min(near * soonest_, near * latest_),
                     last = std::max(far * soonest_, far * latest_);
        // 0 times infinity, on a plane and parallel to it, is not a number and clips nothing.
        enter = first > enter ? first : enter;
        leave = last < leave ? last : leave;
    }
    // [clip_slab]

  private:
    bool backwards_ = false;
    double near_origin_ = infinity, far_origin_ = -infinity;
    double soonest_ = 1.0, latest_ = 1.0;  ///< reciprocals of the speed's bounds
};

}  // namespace space
