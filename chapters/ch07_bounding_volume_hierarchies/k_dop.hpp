/// @file
/// k-DOPs: polytopes with at most k sides, whose k / 2 normals are the same for all of them
/// (Klosowski et al. 1998).
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bounding_volume.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/slab.hpp"
#include "common/geometry.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// In space 6, 14, 18 or 26 sides; in the plane 4 or 8.
template <int K, int D>
inline constexpr bool has_k_dop =
    D == 2 ? K == 4 || K == 8 : K == 6 || K == 14 || K == 18 || K == 26;

// [k_dop_normal]
/// The axes, then what goes from the middle of a cube to its corners, then to its edges: both ways
/// are one. Components are -1, 0 and 1, so that a product with a point is a sum.
template <int K, int D>
Vector<D> k_dop_normal(std::size_t i) {
    static_assert(has_k_dop<K, D>);
    if constexpr (D == 2) {
        constexpr std::array<Vector2, 4> normals{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
        return normals[i];
    } else {
        constexpr std::array<Vector3, 13> normals{{{1, 0, 0},
                                                   {0, 1, 0},
                                                   {0, 0, 1},
                                                   {1, 1, 1},
                                                   {1, 1, -1},
                                                   {1, -1, 1},
                                                   {1, -1, -1},
                                                   {1, 1, 0},
                                                   {1, -1, 0},
                                                   {1, 0, 1},
                                                   {1, 0, -1},
                                                   {0, 1, 1},
                                                   {0, 1, -1}}};
        return normals[K == 18 && i >= 3 ? i + 4 : i];  // edges, but no corners
    }
}
// [k_dop_normal]

// [k_dop]
/// The common part of slabs along the normals.
template <int K, int D = 3>
struct KDop {
    std::array<Slab, K / 2> slabs{};

    bool is_empty() const { return slabs[0].is_empty(); }
    void extend(const Point<D>& p) {
        for (std::size_t i = 0; i < slabs.size(); ++i)
            slabs[i].extend(dot_range<D>(k_dop_normal<K, D>(i), p));
    }
    bool operator==(const KDop&) const = default;
};

template <int K, int D>
KDop<K, D> k_dop_around(std::span<const Point<D>> points) {
    KDop<K, D> dop;
    for (const Point<D>& p : points) dop.extend(p);
    return dop;
}

/// The smallest around both: as boxes are merged.
template <int K, int D>
KDop<K, D> merged(KDop<K, D> a, const KDop<K, D>& b) {
    for (std::size_t i = 0; i < a.slabs.size(); ++i) a.slabs[i].extend(b.slabs[i]);
    return a;
}
// [k_dop]

// ---- its sides --------------------------------------------------------------------------------

/// The corners of a flat convex polygon in order.
template <int D>
using FlatPolygon = std::vector<Double<D>>;

/// The part of it with n . p <= limit (Sutherland & Hodgman 1974).
template <int D>
FlatPolygon<D> part_below(const FlatPolygon<D>& polygon, const Double<D>& n, double limit) {
    FlatPolygon<D> part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Double<D>&p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = limit - glm::dot(n, p), at_q = limit - glm::dot(n, q);
        if (at_p >= 0.0) part.push_back(p);
        if (at_p * at_q < 0.0) part.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    return part;
}

/// The middle of the slabs along the axes, and the length of their box's diagonal.
template <int K, int D>
std::pair<Double<D>, double> middle_and_size(const KDop<K, D>& dop) {
    Double<D> middle, widths;
    for (std::size_t i = 0; i < D; ++i) {
        middle[int(i)] = 0.5 * dop.slabs[i].low + 0.5 * dop.slabs[i].high;
        widths[int(i)] = dop.slabs[i].width();
    }
    return {middle, glm::length(widths)};
}

// [sides_of]
/// What the other slabs leave of a polygon that is large enough, seen from the middle.
template <int K, int D>
FlatPolygon<D> clipped_by_slabs(FlatPolygon<D> polygon, const KDop<K, D>& dop,
                                const Double<D>& middle, std::size_t but_not) {
    for (std::size_t i = 0; i < dop.slabs.size(); ++i) {
        if (i == but_not) continue;
        const Double<D> n(k_dop_normal<K, D>(i));
        polygon = part_below<D>(polygon, n, dop.slabs[i].high - glm::dot(n, middle));
        polygon = part_below<D>(polygon, -n, glm::dot(n, middle) - dop.slabs[i].low);
    }
    return polygon;
}

/// In the plane: the whole outline, seen from the middle.
template <int K>
FlatPolygon<2> outline_of(const KDop<K, 2>& dop) {
    const auto [middle, size] = middle_and_size(dop);
    const FlatPolygon<2> square{{-size, -size}, {size, -size}, {size, size}, {-size, size}};
    return clipped_by_slabs<K, 2>(square, dop, middle, dop.slabs.size());
}

/// A side, and how far its plane is from the middle.
struct KDopSide {
    FlatPolygon<3> polygon;
    double distance;
};
/// In space: a large square in each plane, clipped by all other slabs.
template <int K>
std::vector<KDopSide> sides_of(const KDop<K, 3>& dop) {
    std::vector<KDopSide> sides;
    const auto [middle, size] = middle_and_size(dop);
    for (std::size_t i = 0; i < dop.slabs.size(); ++i)
        for (const double sign : {-1.0, 1.0}) {
            const Double3 n = sign * Double3(k_dop_normal<K, 3>(i));
            const double limit = sign * (sign < 0.0 ? dop.slabs[i].low : dop.slabs[i].high);
            const double distance = (limit - glm::dot(n, middle)) / glm::length(n);
            const Frame<3> frame = frame_about(n);
            const Double3 foot = distance * frame[2], u = size * frame[0], v = size * frame[1];
            sides.push_back(
                {clipped_by_slabs<K, 3>({foot - u - v, foot + u - v, foot + u + v, foot - u + v},
                                        dop, middle, i),
                 distance});
        }
    return sides;
}
// [sides_of]

/// Twice the signed area of a triangle with these two sides.
inline double planar_cross(const Double2& a, const Double2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Of a flat polygon: triangles from its first corner.
template <int D>
double area_of(const FlatPolygon<D>& polygon) {
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Double<D> a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
        if constexpr (D == 2)
            sum += 0.5 * std::abs(planar_cross(a, b));
        else
            sum += 0.5 * glm::length(glm::cross(a, b));
    }
    return sum;
}

template <int K, int D>
double surface(const KDop<K, D>& dop) {
    if (dop.is_empty()) return 0.0;
    double sum = 0.0;
    if constexpr (D == 2) {
        const FlatPolygon<2> outline = outline_of(dop);
        for (std::size_t i = 0; i < outline.size(); ++i)
            sum += glm::distance(outline[i], outline[(i + 1) % outline.size()]);
    } else {
        for (const KDopSide& side : sides_of(dop)) sum += area_of<3>(side.polygon);
    }
    return sum;
}
/// The pyramids from the middle to the sides.
template <int K, int D>
double content(const KDop<K, D>& dop) {
    if (dop.is_empty()) return 0.0;
    if constexpr (D == 2) return area_of<2>(outline_of(dop));
    double sum = 0.0;
    if constexpr (D == 3)
        for (const KDopSide& side : sides_of(dop))
            sum += area_of<3>(side.polygon) * side.distance / 3.0;
    return sum;
}

// ---- rays -------------------------------------------------------------------------------------

/// A ray along all normals, once for all k-DOPs.
template <int K, int D>
struct KDopRay {
    std::array<SlabRay, K / 2> along;
    double tmin, tmax;

    explicit KDopRay(const BasicRay<D>& ray) : tmin(ray.tmin), tmax(ray.tmax) {
        for (std::size_t i = 0; i < along.size(); ++i)
            along[i] = SlabRay(k_dop_normal<K, D>(i), ray);
    }
};
template <int K, int D>
KDopRay<K, D> prepared_for(const BasicRay<D>& ray, const KDop<K, D>&) {
    return KDopRay<K, D>(ray);
}

// [meets_k_dop]
/// The axes come first: most rays that miss are out before the slanting slabs.
template <int K, int D>
bool meets(const KDopRay<K, D>& ray, const KDop<K, D>& dop) {
    double enter = ray.tmin, leave = ray.tmax;
    for (std::size_t i = 0; i < dop.slabs.size(); ++i) {
        ray.along[i].clip(dop.slabs[i], enter, leave);
        if (!(enter <= leave)) return false;
    }
    return true;
}
// [meets_k_dop]

}  // namespace space
