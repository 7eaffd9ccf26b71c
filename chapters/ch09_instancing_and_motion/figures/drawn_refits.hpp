/// @file
/// Walkers who have crossed a square, and three trees around them: refitted, refitted with
/// rotations, built anew.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace space::ch09 {

/// The square's side. Walkers are bars.
inline constexpr double square_side = 16.0;
inline constexpr std::size_t square_walkers = 8;
/// Where they are when the tree is built, and how far they go then.
std::vector<Segment> walkers_at_rest();
inline constexpr std::array<Double2, square_walkers> walkers_ways{
    Double2(10.5, 9.5), Double2(-1.5, 1.0),  Double2(-9.5, 10.5), Double2(-1.0, 1.5),
    Double2(1.0, -1.5), Double2(9.5, -10.0), Double2(1.0, -2.0),  Double2(-8.5, -10.5)};
inline constexpr Double2 refits_from{0.75, 5.0}, refits_through{6.0, 4.625};

/// A tree around them where they are now.
struct FollowedTree {
    std::string_view name;
    BvhNodes<2> nodes = {};
    double expected = 0.0;                    ///< cost of a ray; a node and a test cost 1 each
    std::vector<std::uint32_t> visited = {};  ///< nodes that the ray has come to
    std::vector<std::uint32_t> tested = {};   ///< walkers
    double nearest = infinity;                ///< t of the hit
};
std::array<FollowedTree, 3> followed_trees(std::span<const Segment> rest,
                                           std::span<const Segment> moved, const Ray2& ray);

/// Of the first tree's plane.
inline constexpr PlaneView refits_view{.corner = {8, 34}, .scale = 12.5, .size = square_side};
Svg drawn_refits(std::span<const Segment> rest, std::span<const Segment> moved, const Ray2& ray,
                 const std::array<FollowedTree, 3>& trees);

}  // namespace space::ch09
