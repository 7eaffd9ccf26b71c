/// @file
/// The build of a BSP tree over segments, as the builder told it, step by step.
#pragma once

#include "chapters/ch03_bsp_trees/figures/recorded_build.hpp"
#include "common/program/svg.hpp"

#include <string>

namespace space::ch03 {

Svg drawn_build(std::string title, const Story& story);

/// A sentence: what the builder has made.
std::string summed_up(const Story& story);

/// Where such a drawing has its plane.
PlaneView build_view();

}  // namespace space::ch03
