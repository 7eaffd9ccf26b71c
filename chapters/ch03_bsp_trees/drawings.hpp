/// @file
/// The drawings of chapter 3, for the table in figures.cpp.
#pragma once

#include "common/options.hpp"

namespace space {

void draw_heinonen_plane(const Options& options);  ///< fig_03_01
void draw_heinonen_tree(const Options& options);   ///< fig_03_02
void draw_step_through(const Options& options);   ///< fig_03_10

}  // namespace space
