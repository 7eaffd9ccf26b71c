/// @file
/// A refit with rotations, node by node: the boxes of the plane, and the tree that they are.
#pragma once

#include "common/geometry.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <array>
#include <span>
#include <vector>

namespace space::ch09 {

/// How far the segments A to G go in figure 9.17.
inline constexpr std::array<Double2, 7> first_drift{
    Double2(3.2, -1.6), Double2(-0.6, 0.9), Double2(0.4, 1.2),  Double2(-0.2, -0.6),
    Double2(1.0, 0.6),  Double2(-1.2, 2.2), Double2(-0.5, -0.6)};

/// Each segment goes its way.
std::vector<Segment> drifted(std::span<const Segment> rest, std::span<const Double2> ways);

/// Where the plane is.
inline constexpr PlaneView rotations_view{.corner = {20, 26}, .scale = 20, .size = heinonen_size};

/// The tree is built around segments at rest; they may be as many as there are letters.
Svg drawn_rotations(std::span<const Segment> rest, std::span<const Segment> moved);

}  // namespace space::ch09
