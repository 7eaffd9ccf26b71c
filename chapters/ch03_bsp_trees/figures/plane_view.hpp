/// @file
/// What the drawings of chapter 3 have in common: cells, lines and names in the plane.
#pragma once

#include "chapters/ch03_bsp_trees/figures/recorded_build.hpp"
#include "common/program/plane_view.hpp"

#include <utility>

namespace space::ch03 {

/// How faintly the i-th of a node's cells is filled: neighbours differ.
Style cell_style(const Story& story, std::size_t cell);

/// Where the name of a piece of Heinonen16's segments stands.
Point2 heinonen_name_place(const PlaneView& view, const Piece& piece);

/// The splitter's line within its node's cell: its two ends.
std::pair<Double2, Double2> line_in_cell(const Story& story, std::size_t turn);

}  // namespace space::ch03
