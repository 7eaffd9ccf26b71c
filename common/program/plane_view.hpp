/// @file
/// Drawings of the plane: a map from it to the paper, convex parts of it, segments with their
/// names.
#pragma once

#include "common/program/svg.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace space {

/// A convex part of the plane: its corners in order.
using ConvexCell = std::vector<Double2>;

/// The part of a convex cell where height(point) is not negative; the height is linear.
template <class Height>
ConvexCell part_above(const ConvexCell& cell, const Height& height) {
    ConvexCell part;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const Double2 &p = cell[i], &q = cell[(i + 1) % cell.size()];
        const double at_p = height(p), at_q = height(q);
        if (at_p >= 0.0) part.push_back(p);
        if (at_p * at_q < 0.0) part.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    return part;
}

/// Where a point of the plane stands on the paper: y upwards becomes y downwards.
struct PlaneView {
    Double2 corner;  ///< of the paper: the top left of the frame
    double scale;    ///< paper units for one of the plane
    double size;     ///< height of the frame, in the plane
    Point2 operator()(const Double2& p) const {
        return Point2(corner + scale * Double2(p.x, size - p.y));
    }
    std::vector<Point2> operator()(const ConvexCell& cell) const;
};

/// A segment as a bar; a tick on its front side, which is on the left of the way from `from` to
/// `to`.
void draw_segment(Svg& svg, const PlaneView& view, const Double2& from, const Double2& to,
                  const Style& style);
void draw_front_tick(Svg& svg, const PlaneView& view, const Double2& from, const Double2& to,
                     Ink ink = Ink::ink);
/// A point of the paper `away` from the segment on its front, on its back where negative.
Point2 beside(const PlaneView& view, const Double2& from, const Double2& to, double along,
              double away);

/// A segment, or a piece of one: "C1" and "C2" are pieces of C.
struct NamedSegment {
    std::string name;
    Double2 from, to;
};
/// "C1" as drawings write it: "*C*_{1}".
std::string drawn_name(std::string_view name);
/// "C1" as sentences write it: "C₁".
std::string plain_name(std::string_view name);

/// Where the name of one of Heinonen16's segments A to G, or of a piece of it, stands.
Point2 heinonen_name_place(const PlaneView& view, const NamedSegment& segment);
inline constexpr double heinonen_size = 16.0;  ///< of the square that they lie in

}  // namespace space
