/// @file
/// What the drawings of chapter 3 have in common: a map from the plane to the paper, segments,
/// cells, trees.
#pragma once

#include "chapters/ch03_bsp_trees/figures/recorded_build.hpp"
#include "common/program/svg.hpp"

#include <utility>
#include <vector>

namespace space::ch03 {

/// Where a point of the plane stands on the paper: y upwards becomes y downwards.
struct PlaneView {
    Double2 corner;  ///< of the paper: the top left of the frame
    double scale;    ///< paper units for one of the plane
    double size;     ///< of the frame, in the plane
    Point2 operator()(const Double2& p) const {
        return Point2(corner + scale * Double2(p.x, size - p.y));
    }
    std::vector<Point2> operator()(const ConvexCell& cell) const;
};

/// How faintly the i-th of a node's cells is filled: neighbours differ.
Style cell_style(const Story& story, std::size_t cell);

/// A segment as a bar with a tick on its front side; the name stands `away` from its middle, on its
/// back where negative.
void draw_segment(Svg& svg, const PlaneView& view, const Double2& from, const Double2& to,
                  const Style& style);
void draw_front_tick(Svg& svg, const PlaneView& view, const Double2& from, const Double2& to,
                     Ink ink = Ink::ink);
Point2 beside(const PlaneView& view, const Double2& from, const Double2& to, double along,
              double away);

/// Where the name of one of Heinonen16's segments, or of its piece, stands.
Point2 heinonen_name_place(const PlaneView& view, const Piece& piece);

/// The splitter's line within its node's cell: its two ends.
std::pair<Double2, Double2> line_in_cell(const Story& story, std::size_t turn);

}  // namespace space::ch03
