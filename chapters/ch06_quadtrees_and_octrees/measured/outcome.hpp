/// @file
/// What is made of chapter 6's measurements: tables, charts, verdicts, and what the text quotes.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/measured/data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/results.hpp"

namespace space::ch06 {

Chart points_chart(const std::vector<PointTree>& points);  ///< cells against (d + 1) n
Chart depths_chart(const std::vector<TreePoint>& depths);  ///< time against memory
Chart shapes_chart(const std::vector<TreePoint>& trees);   ///< depth and references, by scene
Chart rays_chart(const std::vector<TreePoint>& trees);     ///< rays per second, by scene
Chart build_chart(const std::vector<TreePoint>& growth);

/// P4.
std::vector<ClaimAnswer> answer_claims(const Measurements& measured);

/// Counts; times too, where they mean something.
void print_trees(const std::vector<TreePoint>& trees, bool times);
void print_growth(const std::vector<TreePoint>& growth, bool times);
void print_depths(const std::vector<TreePoint>& depths, bool times);
void print_points(const std::vector<PointTree>& points, bool times);
void print_segments(const std::vector<SegmentTree>& segments);
void print_codes(const std::vector<CodePoint>& codes);
void print_sorts(const std::vector<SortTimes>& sorts);
void print_searches(const std::vector<SearchPoint>& searches, bool times);
void print_overlaps(const std::vector<OverlapPoint>& overlaps);
void print_planes(const std::vector<PlanePoint>& planes);

/// What the text quotes; times where there are any.
Numbers quoted(const Measurements& measured, bool times);

}  // namespace space::ch06
