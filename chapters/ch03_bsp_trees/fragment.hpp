/// @file
/// Fragments of polygons: on which side of a plane they lie, and how a plane cuts them in two. Four
/// grades of care.
#pragma once

#include "chapters/ch03_bsp_trees/exact_corner.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// How sides are decided and cuts computed.
enum class Grade {
    thick_float,    ///< floats; what lies within a thickness of the plane is on it; each polygon is
                    ///< cut in its own order
    ordered_float,  ///< the same, but an edge is cut from its back end to its front end, whichever
                    ///< polygon it belongs to
    ordered_double,  ///< the same in double
    exact,           ///< corners are held as meets of input planes and decided exactly
};

/// Where a polygon or a fragment lies, seen from a plane.
enum class PlaneSide { front, back, coplanar, straddling };

/// A convex piece of an input polygon: corners in the polygon's order, in its plane.
template <int D>
struct Fragment {
    /// A corner and what the edges at it lie on.
    struct Corner {
        Double<D> at;                         ///< exact, or within `error` of the exact corner
        double error = 0.0;                   ///< 0 for a corner of the polygon itself
        std::array<Carrier, D - 1> carriers;  ///< in space, of the edge that comes in and of the
                                              ///< one that goes out; in the plane, of this end
    };

    std::uint32_t polygon;
    std::vector<Corner> corners;
};

template <int D>
Fragment<D> whole_polygon(const Simplex<D>& points, std::uint32_t polygon) {
    Fragment<D> fragment{polygon, {}};
    for (int i = 0; i < D; ++i) {
        const Carrier here = Carrier::original(i);
        if constexpr (D == 2)
            fragment.corners.push_back({Double2(points[i]), 0.0, {here}});
        else
            fragment.corners.push_back(
                {Double3(points[i]), 0.0, {Carrier::original((i + 2) % 3), here}});
    }
    return fragment;
}

/// Decides and cuts in one grade. Looks at the input polygons and the planes: what exact corners
/// are made of.
template <int D>
class Cutter {
  public:
    using Corner = typename Fragment<D>::Corner;

    /// `thickness` is a distance in scene units; the exact grade knows none.
    Cutter(std::span<const Simplex<D>> polygons, std::span<const SplitPlane<D>> planes, Grade grade,
           double thickness)
        : polygons_(polygons), planes_(planes), grade_(grade), thickness_(thickness) {}

    /// Of each corner: 1 in front of the plane, 0 on it, -1 behind.
    void corner_sides(const Fragment<D>& fragment, const SplitPlane<D>& plane,
                      std::vector<int>& sides) const {
        sides.clear();
        for (const Corner& corner : fragment.corners)
            sides.push_back(side(fragment, corner, plane));
    }

    // [classify]
    static PlaneSide classify(std::span<const int> corner_sides) {
        const bool front = std::ranges::find(corner_sides, 1) != corner_sides.end();
        const bool back = std::ranges::find(corner_sides, -1) != corner_sides.end();
        return front && back ? PlaneSide::straddling
               : front       ? PlaneSide::front
               : back        ? PlaneSide::back
                             : PlaneSide::coplanar;
    }
    // [classify]

    // [split]
    /// The two pieces of a straddling fragment: corners on the plane go to both, and so does the
    /// cut of each edge whose ends lie on different sides. Where the polygon's border is on the
    /// other side, a piece's own runs along the plane.
    std::pair<Fragment<D>, Fragment<D>> split(const Fragment<D>& fragment,
                                              std::span<const int> sides,
                                              std::uint32_t plane) const {
        Fragment<D> front{fragment.polygon, {}}, back{fragment.polygon, {}};
        const std::size_t count = fragment.corners.size(), edges = D == 2 ? 1 : count;
        for (std::size_t i = 0; i < count; ++i) {
            const Corner& corner = fragment.corners[i];
            const int before = sides[(i + count - 1) % count], side = sides[i],
                      after = sides[(i + 1) % count];
            const bool on = side == 0;
            if (side >= 0)
                front.corners.push_back(bordered(corner, on && before < 0, on && after < 0, plane));
            if (side <= 0)
                back.corners.push_back(bordered(corner, on && before > 0, on && after > 0, plane));
            if (i >= edges || side * after >= 0) continue;
            const Corner cut = cut_edge(fragment, i, side < 0, plane);
            front.corners.push_back(bordered(cut, side<0, side> 0, plane));
            back.corners.push_back(bordered(cut, side > 0, side < 0, plane));
        }
        return {std::move(front), std::move(back)};
    }
    // [split]

    /// At least D corners at different points, so that something is left to look at. Cuts in floats
    /// can make less.
    static bool has_extent(const Fragment<D>& fragment) {
        std::size_t different = 0;
        for (std::size_t i = 0; i < fragment.corners.size(); ++i) {
            bool seen = false;
            for (std::size_t j = 0; j < i; ++j)
                seen = seen || fragment.corners[j].at == fragment.corners[i].at;
            different += !seen;
        }
        return different >= std::size_t{D};
    }

  private:
    // [side]
    int side(const Fragment<D>& fragment, const Corner& corner, const SplitPlane<D>& plane) const {
        if (grade_ == Grade::exact) {
            if (const auto side = side_filter(plane, corner.at, corner.error)) return *side;
            return exact_side<D>(plane.through, name_of(fragment, corner.carriers));
        }
        const double distance = inexact_distance(plane, corner.at);
        const double limit =
            grade_ == Grade::ordered_double ? thickness_ * plane.length : thickness_;
        return distance > limit ? 1 : distance < -limit ? -1 : 0;
    }
    // [side]

    /// What a corner of the fragment on these carriers is, exactly.
    Meet<D> name_of(const Fragment<D>& fragment, const std::array<Carrier, D - 1>& carriers) const {
        return {polygons_[fragment.polygon], carriers, planes_};
    }

    /// Signed distance from the plane in the grade's precision: in scene units in floats, times
    /// |normal| in double.
    double inexact_distance(const SplitPlane<D>& plane, const Double<D>& p) const {
        if (grade_ == Grade::ordered_double) return plane.distance(p);
        return glm::dot(plane.unit, Point<D>(p)) - glm::dot(plane.unit, plane.through[0]);
    }

    /// The corner in a piece whose border comes to it along the plane, or goes on along it.
    static Corner bordered(Corner corner, bool comes, bool goes, std::uint32_t plane) {
        if (comes) corner.carriers.front() = Carrier::plane(plane);
        if (goes) corner.carriers.back() = Carrier::plane(plane);
        return corner;
    }

    // [cut_edge]
    /// Where the edge from corner i to the next crosses the plane; in the middle of the edge, so
    /// that this is what carries it on both sides.
    Corner cut_edge(const Fragment<D>& fragment, std::size_t i, bool from_back,
                    std::uint32_t plane_number) const {
        const Corner& here = fragment.corners[i];
        const Carrier edge = here.carriers.back();
        if (grade_ == Grade::exact) return exact_cut(fragment, edge, plane_number);

        const SplitPlane<D>& plane = planes_[plane_number];
        Double<D> p = here.at, q = fragment.corners[(i + 1) % fragment.corners.size()].at;
        // The neighbour across the edge sees it in the opposite direction, and p + s (q - p) rounds
        // differently from q + (1 - s)(p - q): both agree on an order that the plane gives.
        if (grade_ != Grade::thick_float && !from_back) std::swap(p, q);
        const double at_p = inexact_distance(plane, p), at_q = inexact_distance(plane, q);
        if (grade_ == Grade::ordered_double)
            return on_edge(edge, p + (at_p / (at_p - at_q)) * (q - p));
        const Point<D> start(p), end(q);
        const auto s =
            static_cast<float>(at_p) / (static_cast<float>(at_p) - static_cast<float>(at_q));
        return on_edge(edge, Double<D>(start + s * (end - start)));
    }
    // [cut_edge]

    Corner exact_cut(const Fragment<D>& fragment, Carrier edge, std::uint32_t plane) const {
        Corner cut = on_edge(edge, {});
        const Approximation<D> point =
            approximate(name_of(fragment, bordered(cut, false, true, plane).carriers));
        cut.at = point.at;
        cut.error = point.error;
        return cut;
    }

    /// A corner in the middle of an edge, which carries it on both sides.
    static Corner on_edge(Carrier edge, const Double<D>& at) {
        Corner corner{at, 0.0, {}};
        corner.carriers.fill(edge);
        return corner;
    }

    std::span<const Simplex<D>> polygons_;
    std::span<const SplitPlane<D>> planes_;
    Grade grade_;
    double thickness_;
};

}  // namespace space
