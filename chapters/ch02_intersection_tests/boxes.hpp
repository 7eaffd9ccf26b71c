/// @file
/// Ray-box tests: the intersection of three slabs (Kay & Kajiya 1986), in five forms from the plain to the one that never
/// misses. Each says whether the ray meets the closed box within its closed interval, and where.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "common/geometry.hpp"

namespace space {

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
                if (ray.origin[axis] < box.min[axis] || ray.origin[axis] > box.max[axis]) return std::nullopt;
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

/// Branchless with divisions. 0 / 0 is not a number, and std::min and std::max then return one or the other argument:
/// rays in the plane of a face are lost.
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
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) { return intersect(prepare(ray), box); }
};

/// As printed in Optim25: a ray that enters at t <= epsilon is said to start behind the box. It starts inside it.
struct SlabAsPrinted {
    static constexpr float epsilon = 1e-6f;
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) {
        const auto line = SlabReciprocal::intersect(Ray{ray.origin, ray.direction, -infinity, infinity}, box);
        if (!line || !(line->enter > epsilon)) return std::nullopt;
        return line;
    }
};

/// The side of entry by the sign of the reciprocal, and comparisons that keep the interval when they meet
/// something that is not a number (Williams et al. 2005): right for rays in the plane of a face, and for -0.
struct SlabSafe {
    // [slab_safe]
    static std::optional<Interval> intersect(const PreparedBoxRay& ray, const Aabb& box) {
        float enter = ray.tmin, leave = ray.tmax;
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = std::signbit(ray.inverse[axis]);
            const float near = ((backwards ? box.max : box.min)[axis] - ray.origin[axis]) * ray.inverse[axis];
            const float far = ((backwards ? box.min : box.max)[axis] - ray.origin[axis]) * ray.inverse[axis];
            enter = near > enter ? near : enter;
            leave = far < leave ? far : leave;
        }
        if (!(enter <= leave)) return std::nullopt;
        return Interval{enter, leave};
    }
    // [slab_safe]
    static PreparedBoxRay prepare(const Ray& ray) { return PreparedBoxRay(ray); }
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) { return intersect(prepare(ray), box); }
};

/// Never misses a box that the ray meets in exact arithmetic, and reports the interval a little too large.
///
/// A computed t carries three roundings (difference, reciprocal, product): |t' - t| <= gamma(3) |t|, or three times the
/// smallest float where it underflows; gamma(n) = n u / (1 - n u), u = 2^-24 (Higham 2002, lemma 3.1; Ize 2013,
/// JCGT 2:2, for positive t). So t >= t' - margin |t'| - tiny with margin = gamma(3) / (1 - gamma(3)) < 4 u, and
/// the same upwards; the two roundings of the padding itself fit into the fifth u.
/// The reciprocal of a direction below 2^-128 overflows: a ray with such a component takes the double path, where
/// nothing does. Coordinates are at most 2^126, so that no difference overflows.
struct SlabConservative {
    static constexpr float margin = 5.0f * 0x1p-24f;
    static constexpr float tiny = 4.0f * std::numeric_limits<float>::denorm_min();

    struct Prepared : PreparedBoxRay {
        bool in_double;
        Vector3 direction;
        explicit Prepared(const Ray& ray) : PreparedBoxRay(ray), in_double(false), direction(ray.direction) {
            for (int axis = 0; axis < 3; ++axis)
                in_double = in_double || (ray.direction[axis] != 0.0f && !std::isfinite(inverse[axis]));
        }
    };

    // [slab_conservative]
    static std::optional<Interval> intersect(const Prepared& ray, const Aabb& box) {
        if (ray.in_double) return in_double(ray, box);
        float near = -infinity, far = infinity;
        for (int axis = 0; axis < 3; ++axis) {
            const bool backwards = std::signbit(ray.inverse[axis]);
            const float t0 = ((backwards ? box.max : box.min)[axis] - ray.origin[axis]) * ray.inverse[axis];
            const float t1 = ((backwards ? box.min : box.max)[axis] - ray.origin[axis]) * ray.inverse[axis];
            near = t0 > near ? t0 : near;
            far = t1 < far ? t1 : far;
        }
        const float enter = std::max(ray.tmin, near * (near > 0.0f ? 1.0f - margin : 1.0f + margin) - tiny);
        const float leave = std::min(ray.tmax, far * (far > 0.0f ? 1.0f + margin : 1.0f - margin) + tiny);
        if (!(enter <= leave)) return std::nullopt;
        return Interval{enter, leave};
    }
    // [slab_conservative]
    static Prepared prepare(const Ray& ray) { return Prepared(ray); }
    static std::optional<Interval> intersect(const Ray& ray, const Aabb& box) { return intersect(prepare(ray), box); }

  private:
    static std::optional<Interval> in_double(const Prepared& ray, const Aabb& box) {
        constexpr double double_margin = 4.0 * 0x1p-53;  // two roundings: difference and quotient
        double near = -infinity, far = infinity;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = double{box.min[axis]} - ray.origin[axis], high = double{box.max[axis]} - ray.origin[axis];
            if (ray.direction[axis] == 0.0f) {
                if (low > 0.0 || high < 0.0) return std::nullopt;
                continue;
            }
            const auto [t0, t1] = std::minmax(low / ray.direction[axis], high / ray.direction[axis]);
            near = std::max(near, t0);
            far = std::min(far, t1);
        }
        near -= double_margin * std::abs(near);
        far += double_margin * std::abs(far);
        if (!(near <= far && near <= ray.tmax && far >= ray.tmin)) return std::nullopt;
        return Interval{std::max(ray.tmin, std::nextafter(static_cast<float>(near), -infinity)),
                        std::min(ray.tmax, std::nextafter(static_cast<float>(far), infinity))};
    }
};

}  // namespace space
