/// @file
/// The build of a k-d tree, step by step: what the builder told its observer becomes the steps of a
/// drawing, through which a page leads its reader.
#pragma once

#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <string>

namespace space::ch04 {

/// Segments lie in the square of the drawings; there is one at least.
Svg drawn_build(const Story& story);
/// Where the plane stands.
PlaneView build_view();
/// How large the tree is, and how often leaves name a segment.
std::string told_size(const Story& story);

}  // namespace space::ch04
