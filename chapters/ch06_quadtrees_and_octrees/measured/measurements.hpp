/// @file
/// What chapter 6's program counts and times.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/measured/data.hpp"
#include "common/program/options.hpp"

namespace space::ch06 {

/// How far measurements go.
struct Limits {
    std::size_t rays;
    std::size_t most_triangles;  ///< of growing scenes
    std::size_t most_points;
    std::size_t queries;
    int rounds;  ///< of timed runs; 0: none
};
Limits limits(const Options& options);

/// Scenes of some ten thousand triangles, by all trees.
std::vector<TreePoint> measure_trees(const Options& options);
std::vector<TreePoint> measure_growth(const Options& options);
std::vector<TreePoint> measure_depths(const Options& options);
std::vector<OverlapPoint> measure_overlaps(const Options& options);
/// Rays aimed at corners of cells, against exact arithmetic.
std::vector<PlanePoint> measure_planes(const Options& options);

std::vector<PointTree> measure_points(const Options& options);
std::vector<SegmentTree> measure_segments(const Options& options);
std::vector<CodePoint> measure_codes(const Options& options);
/// Times alone.
std::vector<SortTimes> measure_sorts(const Options& options);
std::vector<SearchPoint> measure_searches(const Options& options);

}  // namespace space::ch06
