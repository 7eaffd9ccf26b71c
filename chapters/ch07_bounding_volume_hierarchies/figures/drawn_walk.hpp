/// @file
/// A ray's walk through a tree of boxes over segments, as the walk told it, step by step.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"
#include "common/program/svg.hpp"

#include <optional>
#include <string>

namespace space::ch07 {

/// A ray that misses the root's box has one step. Of the boxes that are not in hand those of one
/// level are drawn, by steps down from the root; or all.
Svg drawn_walk(std::string title, const Story& story, const Ray2& ray,
               std::optional<unsigned> level = {});

}  // namespace space::ch07
