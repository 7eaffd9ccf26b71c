/// @file
/// Counts of what collapses, kernels' margins and filters do.
#pragma once

#include "chapters/ch10_fast_traversal/measured/walk_counts_data.hpp"
#include "chapters/ch10_fast_traversal/wide_tree.hpp"
#include "common/geometry.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace space::ch10 {

WalkCounts measure_walk_counts(const Options& options);
/// Three orders of a node's children.
std::vector<OrderPoint> order_points(const std::string& scene, const WideTree<8>& tree,
                                     const std::vector<Ray>& rays);
/// Near and far planes at random, near the origin and far from it.
std::vector<SlabErrorPoint> measure_slab_errors(const Options& options);
/// Rays that leave a surface and what the slab tests say of the box that they come from.
std::vector<ReturnPoint> measure_returns(const Options& options);

void print_walk_counts(const WalkCounts& measured);
void quote_walk_counts(const WalkCounts& measured, Numbers& numbers);
/// Hits that were lost or invented, planes on the wrong side, wrong answers.
std::uint64_t wrong_walk_counts(const WalkCounts& measured);

}  // namespace space::ch10
