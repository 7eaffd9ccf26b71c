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

/// Where a fragment lies, seen from a plane.
enum class Side { front, back, on, across };

/// A corner of a fragment.
template <int D>
struct Corner {
    DoublePoint<D> at;  ///< exact, or within `error` of the exact corner
    double error = 0.0;
    Carrier carrier{};  ///< in space: of the edge to the next corner; in the plane: of this end
};
/// A corner of the original polygon; every cut has an error in the exact grade, however small.
template <int D>
bool is_exact(const Corner<D>& corner) {
    return corner.error == 0.0;
}

/// A convex piece of an input polygon: corners in the polygon's order, in its plane.
template <int D>
struct Fragment {
    std::uint32_t polygon;
    std::vector<Corner<D>> corners;
};

template <int D>
Fragment<D> whole_polygon(const Corners<D>& points, std::uint32_t polygon) {
    Fragment<D> fragment{polygon, {}};
    for (int i = 0; i < D; ++i)
        fragment.corners.push_back({DoublePoint<D>(points[i]), 0.0, Carrier::original(i)});
    return fragment;
}

/// The exact corner: where its polygon and the carriers of its two edges meet.
inline Meet3 meet_of(const Fragment<3>& fragment, std::size_t corner,
                     std::span<const Corners<3>> polygons, std::span<const SplitPlane<3>> planes) {
    const std::size_t count = fragment.corners.size();
    const Carrier before = fragment.corners[(corner + count - 1) % count].carrier;
    const Carrier after = fragment.corners[corner].carrier;
    const auto edge = [](Carrier c) { return c.is_original() ? c.edge() : -1; };
    const auto plane = [&](Carrier c) {
        return c.is_original() ? nullptr : &planes[c.number()].through;
    };
    return {&polygons[fragment.polygon], edge(before), edge(after), plane(before), plane(after)};
}
inline Meet2 meet_of(const Fragment<2>& fragment, std::size_t end,
                     std::span<const Corners<2>> polygons, std::span<const SplitPlane<2>> planes) {
    return {&polygons[fragment.polygon], &planes[fragment.corners[end].carrier.number()].through};
}

/// Decides and cuts in one grade. Holds on to the input polygons and the planes: what exact corners
/// are made of.
template <int D>
class Splitter {
  public:
    /// `thickness` is a distance in scene units; the exact grade knows none.
    Splitter(std::span<const Corners<D>> polygons, const std::vector<SplitPlane<D>>& planes,
             Grade grade, double thickness)
        : polygons_(polygons), planes_(planes), grade_(grade), thickness_(thickness) {}

    /// Of each corner: 1 in front of the plane, 0 on it, -1 behind.
    void classify(const Fragment<D>& fragment, std::uint32_t plane, std::vector<int>& sides) const {
        sides.resize(fragment.corners.size());
        for (std::size_t i = 0; i < sides.size(); ++i) sides[i] = side(fragment, i, plane);
    }

    // [place]
    static Side place(std::span<const int> sides) {
        const bool front = std::find(sides.begin(), sides.end(), 1) != sides.end();
        const bool back = std::find(sides.begin(), sides.end(), -1) != sides.end();
        return front && back ? Side::across : front ? Side::front : back ? Side::back : Side::on;
    }
    // [place]

    // [split]
    /// The two pieces of a fragment that lies across the plane: corners on the plane go to both,
    /// and so does the cut of each edge whose ends lie on different sides.
    std::pair<Fragment<D>, Fragment<D>> split(const Fragment<D>& fragment,
                                              std::span<const int> sides,
                                              std::uint32_t plane) const {
        Fragment<D> front{fragment.polygon, {}}, back{fragment.polygon, {}};
        const std::size_t count = fragment.corners.size(), edges = D == 2 ? 1 : count;
        for (std::size_t i = 0; i < count; ++i) {
            const Corner<D>& corner = fragment.corners[i];
            const int side = sides[i], next = i < edges ? sides[(i + 1) % count] : side;
            if (side >= 0)
                front.corners.push_back(leaving(corner, D == 3 && side == 0 && next < 0, plane));
            if (side <= 0)
                back.corners.push_back(leaving(corner, D == 3 && side == 0 && next > 0, plane));
            if (side * next >= 0) continue;
            const Corner<D> cut = cut_edge(fragment, i, side < 0, plane);
            front.corners.push_back(leaving(cut, D == 2 || side > 0, plane));
            back.corners.push_back(leaving(cut, D == 2 || side < 0, plane));
        }
        return {std::move(front), std::move(back)};
    }
    // [split]

    /// At least D corners at different places, so that something is left to look at. Cuts in floats
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
    /// What is left of the polygon along its border continues on the plane where the border crosses
    /// it.
    static Corner<D> leaving(Corner<D> corner, bool on_plane, std::uint32_t plane) {
        if (on_plane) corner.carrier = Carrier::plane(plane);
        return corner;
    }

    int side(const Fragment<D>& fragment, std::size_t corner, std::uint32_t plane_number) const {
        const SplitPlane<D>& plane = planes_[plane_number];
        const Corner<D>& c = fragment.corners[corner];
        if (grade_ == Grade::exact) {
            if (const auto side = side_filter(plane, c.at, c.error)) return *side;
            return exact_side_of(fragment, corner, plane);
        }
        const double distance = inexact_distance(plane, c.at);
        const double limit =
            grade_ == Grade::ordered_double ? thickness_ * plane.length : thickness_;
        return distance > limit ? 1 : distance < -limit ? -1 : 0;
    }

    /// Signed distance from the plane in the grade's precision: in scene units in floats, times
    /// |normal| in double.
    double inexact_distance(const SplitPlane<D>& plane, const DoublePoint<D>& p) const {
        if (grade_ == Grade::ordered_double) return plane.distance(p);
        return glm::dot(plane.unit, Point<D>(p)) - glm::dot(plane.unit, plane.through[0]);
    }

    // [cut_edge]
    /// Where the edge from corner i to the next crosses the plane.
    Corner<D> cut_edge(const Fragment<D>& fragment, std::size_t i, bool from_back,
                       std::uint32_t plane_number) const {
        const SplitPlane<D>& plane = planes_[plane_number];
        const Corner<D>& here = fragment.corners[i];
        if (grade_ == Grade::exact) return exact_cut(fragment, here, plane);

        DoublePoint<D> p = here.at, q = fragment.corners[(i + 1) % fragment.corners.size()].at;
        // The neighbour across the edge sees it in the opposite direction, and p + s (q - p) rounds
        // differently from q + (1 - s)(p - q): both agree on an order that the plane gives.
        if (grade_ != Grade::thick_float && !from_back) std::swap(p, q);
        const double at_p = inexact_distance(plane, p), at_q = inexact_distance(plane, q);
        if (grade_ == Grade::ordered_double)
            return {p + (at_p / (at_p - at_q)) * (q - p), 0.0, here.carrier};
        const Point<D> start(p), end(q);
        const auto s =
            static_cast<float>(at_p) / (static_cast<float>(at_p) - static_cast<float>(at_q));
        return {DoublePoint<D>(start + s * (end - start)), 0.0, here.carrier};
    }
    // [cut_edge]

    Corner<D> exact_cut(const Fragment<D>& fragment, const Corner<D>& here,
                        const SplitPlane<D>& plane) const {
        const Corners<D>& polygon = polygons_[fragment.polygon];
        Approximation<D> point;
        if constexpr (D == 2)
            point = approximate(Meet2{&polygon, &plane.through});
        else if (here.carrier.is_original())
            point = approximate(Meet3{&polygon, here.carrier.edge(), -1, nullptr, &plane.through});
        else
            point = approximate(
                Meet3{&polygon, -1, -1, &planes_[here.carrier.number()].through, &plane.through});
        return {point.at, point.error, here.carrier};
    }

    int exact_side_of(const Fragment<D>& fragment, std::size_t corner,
                      const SplitPlane<D>& plane) const {
        const Corner<D>& c = fragment.corners[corner];
        if (is_exact(c)) return exact_side<D>(plane.through, Point<D>(c.at));
        return exact_side(plane.through, meet_of(fragment, corner, polygons_, planes_));
    }

    std::span<const Corners<D>> polygons_;
    const std::vector<SplitPlane<D>>& planes_;
    Grade grade_;
    double thickness_;
};

}  // namespace space
