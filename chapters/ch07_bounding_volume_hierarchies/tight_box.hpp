/// @file
/// The smallest oriented rectangle around points of the plane, and by it a nearly smallest oriented
/// box in space. Small is what few random rays meet: the boundary's length, the surface.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/k_dop.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/oriented_bounds.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace space {

// [convex_hull]
/// The corners of the convex hull, counter-clockwise (Andrew 1979): from left to right below, and
/// back above. Roundings may lose a corner that hardly stands out; boxes are made around all points
/// in the end.
inline std::vector<Double2> convex_hull(std::vector<Double2> points) {
    std::ranges::sort(points, {}, [](const Double2& p) { return std::pair(p.x, p.y); });
    std::vector<Double2> hull;
    const auto add = [&](const Double2& p, std::size_t begin) {
        while (hull.size() >= begin + 2 &&
               planar_cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
            hull.pop_back();
        if (hull.empty() || hull.back() != p) hull.push_back(p);
    };
    for (const Double2& p : points) add(p, 0);
    const std::size_t right = hull.empty() ? 0 : hull.size() - 1;
    for (std::size_t i = points.size(); i-- > 0;) add(points[i], right);
    if (hull.size() > 1 && hull.front() == hull.back()) hull.pop_back();
    return hull;
}
// [convex_hull]

/// A direction, and the cost of the rectangle whose one side it is.
struct RectangleSide {
    Double2 along{1.0, 0.0};
    double cost = double{infinity};
};

// [smallest_rectangle]
/// The best side for a cost a b + h (a + b) of a rectangle with sides a and b, which is half the
/// surface of a box of height h over it; for the boundary's length, a + b alone.
///
/// One side lies on an edge of the hull (Freeman & Shapira 1975, for the area). Between two edges
/// the corners that bound the rectangle stay, and with the angle a'' = -a and b'' = -b. Where the
/// cost f = (a + h) (b + h) - h^2 stands still, a' (b + h) = -b' (a + h), so a' b' <= 0 and f'' =
/// -a (b + h) - b (a + h) + 2 a' b' < 0: that is a peak. So all edges are tried in turn, and the
/// corners farthest ahead, across and behind move on with them: rotating calipers (Shamos 1978).
template <class Cost>
RectangleSide smallest_rectangle(const std::vector<Double2>& hull, const Cost& cost) {
    RectangleSide best;
    const std::size_t n = hull.size();
    std::size_t ahead = 1, across = 1, behind = 1;
    for (std::size_t i = 0; n > 1 && i < n; ++i) {
        const Double2 u = glm::normalize(hull[(i + 1) % n] - hull[i]), v(-u.y, u.x);
        const auto move = [&](std::size_t& corner, const Double2& direction) {
            const auto gain = [&] {
                return glm::dot(direction, hull[(corner + 1) % n] - hull[corner % n]);
            };
            while (corner < i + n && gain() > 0.0) ++corner;
        };
        ahead = std::max(ahead, i + 1);
        move(ahead, u);
        across = std::max(across, ahead);
        move(across, v);
        behind = std::max(behind, across);
        move(behind, -u);
        const double length = glm::dot(u, hull[ahead % n] - hull[behind % n]),
                     width = glm::dot(v, hull[across % n] - hull[i]);
        if (cost(length, width) < best.cost) best = {u, cost(length, width)};
    }
    return best;
}
// [smallest_rectangle]

// [tight_box]
/// Two axes of a frame turned about the third, so that the box has the least surface.
struct TurnedFrame {
    Frame<3> frame;
    double half_surface = double{infinity};
};
inline TurnedFrame turned(const Frame<3>& frame, int about, std::span<const Point3> points) {
    const Double3 w = frame[about], u = frame[(about + 1) % 3], v = frame[(about + 2) % 3];
    std::vector<Double2> shadow;
    double low = double{infinity}, high = -double{infinity};
    for (const Point3& p : points) {
        const Double3 q(p);
        shadow.emplace_back(glm::dot(u, q), glm::dot(v, q));
        low = std::min(low, glm::dot(w, q));
        high = std::max(high, glm::dot(w, q));
    }
    const double height = high - low;
    const auto half_surface = [&](double a, double b) { return a * b + height * (a + b); };
    const RectangleSide side = smallest_rectangle(convex_hull(std::move(shadow)), half_surface);
    Frame<3> better = frame;
    better[(about + 1) % 3] = side.along.x * u + side.along.y * v;
    better[(about + 2) % 3] = side.along.x * v - side.along.y * u;
    return {better, side.cost};
}

/// Turns about one axis after the other, as long as that is an improvement that floats would show.
inline TurnedFrame turned_to_rest(const Frame<3>& frame, int about,
                                  std::span<const Point3> points) {
    TurnedFrame best = turned(frame, about, points);
    for (int in_vain = 0; in_vain < 2;) {
        about = (about + 1) % 3;
        const TurnedFrame next = turned(best.frame, about, points);
        const bool better = next.half_surface < best.half_surface * (1.0 - 0x1p-24);
        in_vain = better ? 0 : in_vain + 1;
        if (better) best = next;
    }
    return best;
}

/// The best of those that come to rest, begun with turns about the 13 directions of the 26-DOP and
/// the principal axes. Hardly larger than the smallest box, as tests find; to find that one is far
/// more work (O'Rourke 1985).
inline Frame<3> tight_frame(std::span<const Point3> points) {
    TurnedFrame best{.frame = principal_frame<3>(points)};
    const Frame<3> principal = best.frame;
    const auto try_about = [&](const Frame<3>& frame, int axis) {
        const TurnedFrame found = turned_to_rest(frame, axis, points);
        if (found.half_surface < best.half_surface) best = found;
    };
    for (int axis = 0; axis < 3; ++axis) try_about(principal, axis);
    for (std::size_t i = 0; i < 13; ++i) try_about(frame_about(Double3(k_dop_normal<26, 3>(i))), 2);
    return best.frame;
}
// [tight_box]

/// In the plane the one with the shortest boundary.
inline Frame<2> tight_frame(std::span<const Point2> points) {
    std::vector<Double2> all(points.begin(), points.end());
    const auto half_boundary = [](double a, double b) { return a + b; };
    const Double2 u = smallest_rectangle(convex_hull(std::move(all)), half_boundary).along;
    return {u, Double2(-u.y, u.x)};
}

template <int D>
OrientedBounds<D> tight_box(std::span<const Point<D>> points) {
    return bounds_along<D>(tight_frame(points), points);
}

}  // namespace space
