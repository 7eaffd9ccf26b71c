/// @file
/// A ray's walk through a BSP tree over segments, as the walk told it, step by step.
#pragma once

#include "chapters/ch03_bsp_trees/figures/recorded_build.hpp"
#include "common/program/walk_drawing.hpp"

#include <string>
#include <vector>

namespace space::ch03 {

/// The last step sums up.
std::vector<WalkStep> told_walk(const Story& story, const BasicRay<2>& ray);

Svg drawn_walk(std::string title, const Story& story, const BasicRay<2>& ray,
               const std::vector<WalkStep>& steps);

}  // namespace space::ch03
