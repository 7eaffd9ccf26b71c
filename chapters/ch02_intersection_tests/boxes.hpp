/// @file
/// Ray-box tests: the intersection of three slabs (Kay & Kajiya 1986), in five forms from the plain
/// to the one that never misses. Each says whether the ray meets the closed box within its closed
/// interval, and where.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace space {

/// A closed interval of t.
struct Interval {
    float enter, leave;  ///< the part of [tmin, tmax] in the box
};

/// With a branch at every step, out as early as possible; divides three times.
struct SlabBranching {
    // [slab_branching]
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) {
        float enter = ray.tmin, leave = ray.tmax;
        for (int axis = 0; axis < 3; ++axis) {
            if (ray.direction[axis] == 0.0f) {
                if (ray.origin[axis] < box.min[axis] || ray.origin[axis] > box.max[axis])
                    return std::nullopt;
                continue;
            }
            float near = (box.min[axis] - ray.origin[axis]) / ray.direction[axis];
            float far = (box.max[axis] - ray.origin[axis]) / ray.direction[axis];
            if (near > far) std::swap(near, far);
            if (near > enter) enter = near;
            if (far < leave) leave = far;
            if (enter > leave) return std::nullopt;
        }
        return Interval{enter, leave};
    }
    // [slab_branching]
};

/// Branchless with divisions. 0 / 0 is not a number, and std::min and std::max then return one or
/// the other argument: rays in the plane of a face are lost.
struct SlabMinMax {
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) {
        float enter = ray.tmin, leave = ray.tmax;
        for (int axis = 0; axis < 3; ++axis) {
            const float near = (box.min[axis] - ray.origin[axis]) / ray.direction[axis];
            const float far = (box.max[axis] - ray.origin[axis]) / ray.direction[axis];
            enter = std::max(std::min(near, far), enter);
            leave = std::min(std::max(near, far), leave);
        }
        if (!(enter <= leave)) return std::nullopt;
        return Interval{enter, leave};
    }
};

/// What the other forms need of a ray, once for all boxes.
struct PreparedBoxRay {
    Point3 origin;
    Vector3 inverse;  ///< 1 / direction; +-infinity for +-0
    float tmin, tmax;

    explicit PreparedBoxRay(const Ray& ray)
        : origin(ray.origin), inverse(1.0f / ray.direction), tmin(ray.tmin), tmax(ray.tmax) {}
};

/// Branchless with the reciprocal (Optim25, section 4): 0 times infinity is not a number either.
struct SlabReciprocal {
    // [slab_reciprocal]
    static std::optional<Interval> intersect(const PreparedBoxRay& ray, const Aabb& box) {
        float enter = ray.tmin, leave = ray.tmax;
        for (int axis = 0; axis < 3; ++axis) {
            const float near = (box.min[axis] - ray.origin[axis]) * ray.inverse[axis];
            const float far = (box.max[axis] - ray.origin[axis]) * ray.inverse[axis];
            enter = std::max(std::min(near, far), enter);
            leave = std::min(std::max(near, far), leave);
        }
        if (!(enter <= leave)) return std::nullopt;
        return Interval{enter, leave};
    }
    // [slab_reciprocal]
    static PreparedBoxRay prepare(const Ray& ray) { return PreparedBoxRay(ray); }
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) {
        return intersect(prepare(ray), box);
    }
};

/// As printed in Optim25: a ray that enters at t <= epsilon is said to start behind the box. It
/// starts inside it.
struct SlabAsPrinted {
    static constexpr float epsilon = 1e-6f;
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) {
        const auto line =
            SlabReciprocal::intersect(Ray{ray.origin, ray.direction, -infinity, infinity}, box);
        if (!line || !(line->enter > epsilon)) return std::nullopt;
        return line;
    }
};

/// The side of entry by the sign of the reciprocal, and comparisons that keep the interval when
/// they meet something that is not a number (Williams et al. 2005): right for rays in the plane of
/// a face, and for -0.
struct SlabSafe {
    // [slab_safe]
    static std::optional<Interval> intersect(const PreparedBoxRay& ray, const Aabb& box) {
        float enter = ray.tmin, leave = ray.tmax;
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = std::signbit(ray.inverse[axis]);
            const float near =
                ((backwards ? box.max : box.min)[axis] - ray.origin[axis]) * ray.inverse[axis];
            const float far =
                ((backwards ? box.min : box.max)[axis] - ray.origin[axis]) * ray.inverse[axis];
            enter = near > enter ? near : enter;
            leave = far < leave ? far : leave;
        }
        if (!(enter <= leave)) return std::nullopt;
        return Interval{enter, leave};
    }
    // [slab_safe]
    static PreparedBoxRay prepare(const Ray& ray) { return PreparedBoxRay(ray); }
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) {
        return intersect(prepare(ray), box);
    }
};

/// Never misses a box that the ray meets in exact arithmetic, and reports the interval a little too
/// large: SlabSafe with two reciprocals, one a little short of 1 / d for the near planes, one a
/// little beyond it for the far planes.
///
/// A computed t carries four roundings, each by a factor of 1 +- u24, u24 = 2^-24: the difference,
/// the reciprocal, its shortening (or lengthening) and the product. (1 + u24)^4 (1 - 4 u24) < 1 <
/// (1 - u24)^4 (1 + 6 u24), so the computed t is never farther from 0 than the exact one at a near
/// plane, and never nearer at a far plane. (The float before 1 + 6 u24 is 1 + 4 u24. It would do,
/// but only because no reciprocal is rounded down by all of u24.) That is the safe side for t >= 0;
/// where the exact t is negative the computed one is, too, and either counts as little as the other
/// as long as tmin
/// >= 0. A product below 2^-126 is off by half the smallest float more; `tiny` covers that at both
/// ends. Rays with tmin < 0 or with a reciprocal that is not a normal float, |d| < 2^-128 or |d| >
/// 2^126, take the double path, where none of this matters. Coordinates are at most 2^126, so that
/// no difference overflows.
///
/// Ize 2013 (JCGT 2:2) widens at one end only, `far` by a factor for both. The code that follows it
/// takes 1.00000024, which is 1 + 4 u24: too little, a test has the ray. 1 + 6 u24 is enough: with
/// three roundings in each, near and far are apart by at most (1 + 2 u24)^3 < 1 + 6 u24 + 13 u24^2,
/// and the product with the factor, rounded to a float, cannot end below the float `near` for that.
struct SlabConservative {
    static constexpr float shorten = 1.0f - 4.0f * 0x1p-24f;
    static constexpr float lengthen = 1.0f + 6.0f * 0x1p-24f;
    static constexpr float tiny = std::numeric_limits<float>::denorm_min();

    /// The ray with its reciprocals, for many boxes.
    struct Prepared : PreparedBoxRay {
        Vector3 far_inverse;  ///< and `inverse` is that for near planes
        Vector3 direction;
        bool in_double;

        explicit Prepared(const Ray& ray)
            : PreparedBoxRay(ray),
              far_inverse(inverse * lengthen),
              direction(ray.direction),
              in_double(!(ray.tmin >= 0.0f)) {
            for (int axis = 0; axis < 3; ++axis)
                in_double = in_double || (direction[axis] != 0.0f && !std::isnormal(inverse[axis]));
            inverse *= shorten;
        }
    };

    // [slab_conservative]
    static std::optional<Interval> intersect(const Prepared& ray, const Aabb& box) {
        if (ray.in_double) return in_double(ray, box);
        float enter = ray.tmin, leave = ray.tmax;
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = std::signbit(ray.inverse[axis]);
            const float near =
                ((backwards ? box.max : box.min)[axis] - ray.origin[axis]) * ray.inverse[axis];
            const float far =
                ((backwards ? box.min : box.max)[axis] - ray.origin[axis]) * ray.far_inverse[axis];
            enter = near > enter ? near : enter;
            leave = far < leave ? far : leave;
        }
        leave += tiny;
        if (!(enter <= leave)) return std::nullopt;
        return Interval{std::max(ray.tmin, enter - tiny), leave};
    }
    // [slab_conservative]
    static Prepared prepare(const Ray& ray) { return Prepared(ray); }
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) {
        return intersect(prepare(ray), box);
    }

  private:
    static std::optional<Interval> in_double(const Prepared& ray, const Aabb& box) {
        // With w = 2^-53: difference and quotient round by a factor of 1 +- w each. Where far is g,
        // rounded, near is at most g (1 + w) / (1 - w), rounded. For 1 <= far < 2, g is at most
        // far + w, and so near at most far + (1 + 2 far) w, rounded, but for terms with w^2: that
        // is no more than far + 3 far w, rounded. (Where the terms with w^2 count, next to 1, both
        // sums are rounded alike. Behind the origin, far < 0, signs change and no more.) Against
        // the ends of the ray's interval roundings do nothing: tmax d is a double.
        constexpr double margin = 3.0 * 0x1p-53;
        double near = -infinity, far = infinity;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = double{box.min[axis]} - ray.origin[axis],
                         high = double{box.max[axis]} - ray.origin[axis];
            if (ray.direction[axis] == 0.0f) {
                if (low > 0.0 || high < 0.0) return std::nullopt;
                continue;
            }
            const double t0 = low / ray.direction[axis], t1 = high / ray.direction[axis];
            near = std::max(near, std::min(t0, t1));
            far = std::min(far, std::max(t0, t1));
        }
        if (!(near <= far + margin * std::abs(far) && near <= ray.tmax && far >= ray.tmin))
            return std::nullopt;
        return Interval{std::max(ray.tmin, std::nextafter(static_cast<float>(near), -infinity)),
                        std::min(ray.tmax, std::nextafter(static_cast<float>(far), infinity))};
    }
};

}  // namespace space
