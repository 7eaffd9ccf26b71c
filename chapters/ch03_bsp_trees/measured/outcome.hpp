/// @file
/// What is made of chapter 3's measurements: tables, charts, verdicts, and what the text quotes.
#pragma once

#include "chapters/ch03_bsp_trees/measured/data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/results.hpp"

namespace space::ch03 {

Chart fragments_chart(const std::vector<Growth>& growth);   ///< fig_03_09
Chart build_chart(const std::vector<Growth>& growth);       ///< fig_03_10
Chart rays_chart(const std::vector<Growth>& growth);        ///< fig_03_11
Chart grades_chart(const std::vector<GradePoint>& grades);  ///< fig_03_12

/// H4, H5, H6, H7 and P3.
std::vector<ClaimAnswer> answer_claims(const Measurements& measured);

/// The trees' counts; times too, where they mean something.
void print_methods(const MethodTrees& all, bool times);
void print_scenes(const std::vector<TreePoint>& scenes, bool times);
void print_growth(const std::vector<Growth>& growth, bool times);
void print_crossings(const std::vector<Crossings>& crossings);
void print_grades(const std::vector<GradePoint>& grades, bool times);

/// What the text quotes; times where there are any.
Numbers quoted(const Measurements& measured, bool times);

}  // namespace space::ch03
