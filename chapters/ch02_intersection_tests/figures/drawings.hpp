/// @file
/// The drawings of chapter 2, for the table in figures.cpp.
#pragma once

#include "common/program/options.hpp"

namespace space::ch02 {

void draw_shared_edge(const Options& options);  ///< fig_02_01
void draw_slabs(const Options& options);        ///< fig_02_02
void draw_filter(const Options& options);       ///< fig_02_03
void draw_sphere(const Options& options);       ///< fig_02_04
void draw_newton_root(const Options& options);  ///< fig_02_05

}  // namespace space::ch02
