/// @file
/// What a ray met on its way through a BSP tree of segments: the walk's events, kept in order.
#pragma once

#include "chapters/ch03_bsp_trees/bsp.hpp"

#include <variant>
#include <vector>

namespace space::ch03 {

/// One of the walk's events.
using WalkEvent = std::variant<BspWalk::Visited, BspWalk::Crossed, BspWalk::Dropped>;

/// Looks for the nearest hit, and watches.
std::vector<WalkEvent> watched_walk(const BspTree<2>& tree, const BasicRay<2>& ray);

/// The nearest of the hits with the segments that lie in a node's line, in double; infinity where
/// there is none.
double hit_in(const BspTree<2>& tree, std::uint32_t node, const BasicRay<2>& ray);

}  // namespace space::ch03
