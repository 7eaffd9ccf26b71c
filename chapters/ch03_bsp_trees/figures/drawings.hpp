/// @file
/// The drawings of chapter 3, for the table in figures.cpp.
#pragma once

#include "common/program/options.hpp"

namespace space::ch03 {

void draw_heinonen_plane(const Options& options);  ///< fig_03_01
void draw_heinonen_tree(const Options& options);   ///< fig_03_02
void draw_corners(const Options& options);         ///< fig_03_03
void draw_painters_order(const Options& options);  ///< fig_03_04
void draw_fragments_hit(const Options& options);   ///< fig_03_05
void draw_chain(const Options& options);           ///< fig_03_06
void draw_ray(const Options& options);             ///< fig_03_07
void draw_painting(const Options& options);        ///< fig_03_09
void draw_step_through(const Options& options);    ///< fig_03_10

}  // namespace space::ch03
