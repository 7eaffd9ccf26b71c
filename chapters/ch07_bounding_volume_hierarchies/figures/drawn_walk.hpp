/// @file
/// A ray's walk through a tree of boxes over segments, as the walk told it, step by step.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"
#include "common/program/svg.hpp"

#include <string>

namespace space::ch07 {

/// A ray that misses the root's box has one step.
Svg drawn_walk(std::string title, const Story& story, const Ray2& ray);

}  // namespace space::ch07
