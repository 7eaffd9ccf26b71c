/// @file
/// Whether a segment (D = 2) or triangle (D = 3) and a box have a point in common: always the
/// answer of exact arithmetic.
#pragma once

#include "chapters/ch02_intersection_tests/expansion.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace space {

/// A simplex that boxes are held against. Both are closed: to touch is to overlap.
///
/// Two convex bodies are apart if and only if they are along the normal of a face of one, or along
/// a product of an edge of one and an edge of the other: separating axes (Gottschalk, Lin & Manocha
/// 1996; for a triangle and a box Akenine-Möller 2001). In space these are the box's three axes,
/// the triangle's normal, and nine products of edges. Edge times axis i has no component along i:
/// with i left out, these nine are three planar tests, of the triangle's shadow and the box's
/// (Schwarz & Seidel 2010, section 3). In the plane an axis stands across each side of the box, and
/// one across each edge, on whose outer side the whole box must lie. A shadow that is a segment has
/// two outer sides, and one that is a point no edge: a triangle without area is not a special case.
template <int D>
class SimplexOverlap {
  public:
    explicit SimplexOverlap(const Simplex<D>& simplex) : simplex_(simplex) {
        for (int corner = 0; corner < D; ++corner) bounds_.extend(simplex[corner]);
        if constexpr (D == 3)
            for (int axis = 0; axis < 3; ++axis) {
                const auto [j, k] = others(axis);
                normal_[std::size_t(axis)] =
                    side_of_line(simplex.a, simplex.b, Double3(simplex.c), j, k, NoObserver());
            }
    }

    /// Event: it was asked on which side of a line or plane a corner of a box lies.
    struct Side {
        bool by_filter;  ///< or by exact arithmetic
    };

    // [overlaps]
    template <class Observer = NoObserver>
    bool overlaps(const OrthtreeBox<D>& box, Observer&& observer = {}) const {
        for (int axis = 0; axis < D; ++axis)
            if (double{bounds_.min[axis]} > box.max[axis] ||
                double{bounds_.max[axis]} < box.min[axis])
                return false;
        if constexpr (D == 2)
            return !line_separates(simplex_.a, simplex_.b, box, 0, 1, 0, observer);
        if constexpr (D == 3) {
            if (plane_separates(box, 1, observer) || plane_separates(box, -1, observer))
                return false;
            for (int axis = 0; axis < 3; ++axis) {
                const auto [j, k] = others(axis);
                for (int edge = 0; edge < 3; ++edge)
                    if (line_separates(simplex_[edge], simplex_[(edge + 1) % 3], box, j, k,
                                       normal_[std::size_t(axis)], observer))
                        return false;
            }
        }
        return true;
    }
    // [overlaps]

  private:
    /// The axes that are left, in the order in which the shadow turns as the triangle does.
    static std::array<int, 2> others(int axis) { return {(axis + 1) % 3, (axis + 2) % 3}; }

    // [side_of_line]
    /// On which side of the line from a to b the point lies, seen in the plane of axes j and k:
    /// 1 to the left, 0 on it, -1 to the right.
    ///
    /// With u53 = 2^-53: each product carries three roundings, of two differences and its own, and
    /// their difference a fourth. Off by at most gamma(4) times the sum of the products' sizes; the
    /// fifth u53 is more than the bound's own roundings and the terms with u53^2 take.
    template <class Observer>
    static int side_of_line(const Point<D>& a, const Point<D>& b, const Double<D>& p, int j, int k,
                            Observer&& observer) {
        const double left = (double{b[j]} - a[j]) * (p[k] - a[k]);
        const double right = (double{b[k]} - a[k]) * (p[j] - a[j]);
        const double side = left - right;
        const double bound = 5.0 * 0x1p-53 * (std::abs(left) + std::abs(right));
        const bool by_filter = std::abs(side) > bound;
        observer.observe(Side{by_filter});
        if (by_filter) return side > 0.0 ? 1 : -1;
        return (minus(b[j], a[j]) * minus(p[k], a[k]) - minus(b[k], a[k]) * minus(p[j], a[j]))
            .sign();
    }
    // [side_of_line]

    /// The same for the triangle's plane: 1 in front.
    ///
    /// Each of the six terms carries eight roundings: three differences, two products, and three
    /// sums. The ninth u pays as above.
    template <class Observer>
    int side_of_plane(const Double3& p, Observer&& observer) const {
        const Double3 a(simplex_.a), e1 = Double3(simplex_.b) - a, e2 = Double3(simplex_.c) - a,
                                     q = p - a;
        const Double3 s1 = glm::abs(e1), s2 = glm::abs(e2), sq = glm::abs(q);
        const double side = glm::dot(glm::cross(e1, e2), q);
        const double bound =
            9.0 * 0x1p-53 *
            ((s1.y * s2.z + s1.z * s2.y) * sq.x + (s1.z * s2.x + s1.x * s2.z) * sq.y +
             (s1.x * s2.y + s1.y * s2.x) * sq.z);
        const bool by_filter = std::abs(side) > bound;
        observer.observe(Side{by_filter});
        if (by_filter) return side > 0.0 ? 1 : -1;
        using Exact = Exact3<Expansion<2>>;
        const auto from_a = [&](const Double3& to) {
            return Exact{minus(to.x, simplex_.a.x), minus(to.y, simplex_.a.y),
                         minus(to.z, simplex_.a.z)};
        };
        return dot(cross(from_a(Double3(simplex_.b)), from_a(Double3(simplex_.c))), from_a(p))
            .sign();
    }

    /// Exactly p - a.
    static Expansion<2> minus(double p, double a) {
        const auto [high, low] = two_sum(p, -a);
        Expansion<2> result;
        result.push(low);
        result.push(high);
        return result;
    }

    /// Whether all of the box lies strictly on the outer side of the edge, the inner one being
    /// given by its sign; by 0 where both sides are outer ones. The box's corner that reaches
    /// farthest inwards decides.
    template <class Observer>
    static bool line_separates(const Point<D>& a, const Point<D>& b, const OrthtreeBox<D>& box,
                               int j, int k, int inner, Observer&& observer) {
        if (inner == 0)
            return line_separates(a, b, box, j, k, 1, observer) ||
                   line_separates(a, b, box, j, k, -1, observer);
        Double<D> corner = box.min;
        corner[k] = ((b[j] > a[j]) == (inner > 0) ? box.max : box.min)[k];
        corner[j] = ((b[k] > a[k]) == (inner > 0) ? box.min : box.max)[j];
        return side_of_line(a, b, corner, j, k, observer) == -inner;
    }
    /// Whether all of the box lies strictly behind the plane (front = 1), or in front (front = -1).
    template <class Observer>
    bool plane_separates(const OrthtreeBox<D>& box, int front, Observer&& observer) const {
        Double3 corner;
        for (int axis = 0; axis < 3; ++axis)
            corner[axis] = (normal_[std::size_t(axis)] == front ? box.max : box.min)[axis];
        return side_of_plane(corner, observer) == -front;
    }

    Simplex<D> simplex_;
    BasicAabb<D> bounds_;
    std::array<int, 3> normal_{};  ///< signs of the normal's components (D = 3)
};

}  // namespace space
