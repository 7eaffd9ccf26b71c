/// @file
/// Points, axis-aligned boxes, rays and triangles: the vocabulary of every chapter.
/// Coordinates are floats; D is 2 (the drawings) or 3 (the scenes).
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace space {

template <int D>
using Point = glm::vec<D, float>;
template <int D>
using Vector = glm::vec<D, float>;
using Point2 = Point<2>;
using Point3 = Point<3>;
using Vector2 = Vector<2>;
using Vector3 = Vector<3>;
/// The same in double, for decisions that floats cannot make safely.
template <int D>
using Double = glm::vec<D, double>;
using Double2 = Double<2>;
using Double3 = Double<3>;

inline constexpr float infinity = std::numeric_limits<float>::infinity();

template <int D>
bool is_finite(const Vector<D>& v) {
    for (int axis = 0; axis < D; ++axis)
        if (!std::isfinite(v[axis])) return false;
    return true;
}

/// A closed axis-aligned box; empty while min > max on any axis.
template <int D>
struct BasicAabb {
    Point<D> min{infinity};
    Point<D> max{-infinity};

    static BasicAabb empty() { return {}; }
    bool is_empty() const {
        for (int axis = 0; axis < D; ++axis)
            if (!(min[axis] <= max[axis])) return true;
        return false;
    }
    void extend(const Point<D>& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void extend(const BasicAabb& box) {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }
    /// The middle of the box; halves first, so that huge coordinates do not overflow.
    Point<D> centroid() const { return min * 0.5f + max * 0.5f; }
    /// Edge lengths; zero for an empty box.
    Vector<D> extent() const { return is_empty() ? Vector<D>{0.0f} : max - min; }
    /// Half the surface area (D = 3) or half the perimeter (D = 2); zero for an empty box. In
    /// double: a product of two large floats overflows.
    double half_area() const {
        const glm::vec<D, double> e{extent()};
        if constexpr (D == 2)
            return e.x + e.y;
        else
            return e.x * e.y + e.y * e.z + e.z * e.x;
    }
    int longest_axis() const {
        const Vector<D> e = extent();
        int longest = 0;
        for (int axis = 1; axis < D; ++axis)
            if (e[axis] > e[longest]) longest = axis;
        return longest;
    }
    bool contains(const Point<D>& p) const {
        for (int axis = 0; axis < D; ++axis)
            if (!(min[axis] <= p[axis] && p[axis] <= max[axis])) return false;
        return true;
    }
    bool contains(const BasicAabb& box) const {
        return box.is_empty() || (contains(box.min) && contains(box.max));
    }
    bool operator==(const BasicAabb&) const = default;
};
using Aabb = BasicAabb<3>;
using Aabb2 = BasicAabb<2>;

/// The points origin + t direction with t in the closed interval [tmin, tmax]. The direction need
/// not have length 1: t is in units of the direction.
template <int D>
struct BasicRay {
    Point<D> origin{0.0f};
    Vector<D> direction{0.0f};
    float tmin = 0.0f;
    float tmax = infinity;

    Point<D> at(float t) const { return origin + t * direction; }
};
using Ray = BasicRay<3>;
using Ray2 = BasicRay<2>;

/// A ray can hit something only if its origin and direction are finite, its direction is not zero
/// and its interval holds a number (NaN fails every comparison).
template <int D>
bool is_valid(const BasicRay<D>& ray) {
    return is_finite<D>(ray.origin) && is_finite<D>(ray.direction) &&
           ray.direction != Vector<D>{0.0f} && ray.tmin <= ray.tmax;
}

/// Three points; the front side is the one that (b - a) x (c - a) points to.
struct Triangle {
    Point3 a, b, c;

    const Point3& operator[](int corner) const { return corner == 0 ? a : corner == 1 ? b : c; }
    bool operator==(const Triangle&) const = default;
};

inline Aabb bounds(const Triangle& triangle) {
    Aabb box;
    box.extend(triangle.a);
    box.extend(triangle.b);
    box.extend(triangle.c);
    return box;
}

/// Not normalised: its length is twice the area. In double, where the products of float differences
/// are exact or nearly so.
inline Double3 normal(const Triangle& triangle) {
    const Double3 a{triangle.a}, b{triangle.b}, c{triangle.c};
    return glm::cross(b - a, c - a);
}

/// A line segment in the plane: the drawings' polygon.
struct Segment {
    Point2 a, b;

    const Point2& operator[](int end) const { return end == 0 ? a : b; }
    bool operator==(const Segment&) const = default;
};

/// What is split, sorted and traced in D dimensions: D points that span a line or a plane.
template <int D>
using Simplex = std::conditional_t<D == 2, Segment, Triangle>;

/// Its box; empty where a coordinate is no number, or infinite: no ray can hit such a polygon.
/// (Were it kept, a box would forget or swallow all others: every comparison with what is not a
/// number is false, and areas would be infinite.)
template <int D>
BasicAabb<D> box_if_finite(const Simplex<D>& polygon) {
    BasicAabb<D> box;
    for (int corner = 0; corner < D; ++corner) {
        if (!is_finite<D>(polygon[corner])) return {};
        box.extend(polygon[corner]);
    }
    return box;
}

}  // namespace space
