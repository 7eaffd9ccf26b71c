/// @file
/// What is made of chapter 4's measurements: tables, charts, verdicts, and what the text quotes.
#pragma once

#include "chapters/ch04_kd_trees/measured/data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/results.hpp"

namespace space::ch04 {

Chart rules_chart(const std::vector<TreePoint>& trees);  ///< build time against rays per second
Chart care_chart(const std::vector<CarePoint>& care);    ///< time against lost hits
Chart rays_chart(const std::vector<Growth>& growth);     ///< nodes and tests per ray
Chart build_chart(const std::vector<Growth>& growth);
Chart points_chart(const std::vector<PointSet>& points);

/// H8, H9, H10, L6, L7, L10, P5, P6 and P19.
std::vector<ClaimAnswer> answer_claims(const Measurements& measured);

/// Counts; times too, where they mean something.
void print_pictures(const std::vector<PicturePoint>& pictures);
void print_cures(const std::vector<CurePoint>& cures, bool times);
void print_trees(const std::vector<TreePoint>& trees, bool times);
void print_growth(const std::vector<Growth>& growth, bool times);
void print_care(const std::vector<CarePoint>& care, bool times);
void print_overlaps(const std::vector<OverlapPoint>& overlaps);
void print_points(const std::vector<PointSet>& points, bool times);
void print_planes(const std::vector<PlaneTimes>& planes);

/// What the text quotes; times where there are any.
Numbers quoted(const Measurements& measured, bool times);

}  // namespace space::ch04
