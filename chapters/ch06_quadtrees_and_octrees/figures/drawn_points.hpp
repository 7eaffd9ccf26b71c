/// @file
/// A quadtree of points, built step by step: the plane, the tree, and the points in the order of
/// their codes, of which each cell is a range.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_points.hpp"
#include "common/geometry.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <string>
#include <vector>

namespace space::ch06 {

/// Points in the square from 0 to 16, 26 at most, called A, B ..; B lies on the line between the
/// lower two cells.
struct PointScene {
    std::vector<Point2> points{{2.5f, 3.0f},    {8.0f, 4.5f},    {13.0f, 2.0f},
                               {13.5f, 5.5f},   {3.0f, 12.5f},   {9.25f, 9.0f},
                               {10.75f, 11.0f}, {11.25f, 9.25f}, {14.0f, 14.25f}};
    LinearOrthtreeConfig config{.leaf_size = 1, .max_depth = 6};
};

/// The tree that the builder makes of them.
struct DrawnPoints {
    Svg drawing;
    std::string tells;  ///< in a sentence or two
};
DrawnPoints drawn_points(const PointScene& scene);
/// Where the plane stands.
PlaneView points_view();

}  // namespace space::ch06
