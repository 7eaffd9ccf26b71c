/// @file
/// What is made of the measurements of trees: tables, charts, verdicts, and what the text quotes.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/measured/data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/results.hpp"

#include <vector>

namespace space::ch07 {

Chart pareto_chart(const std::vector<TreePoint>& trees);   ///< build time against rays
Chart peers_chart(const std::vector<TreePoint>& trees);    ///< rays per second beside Embree's
Chart growth_chart(const std::vector<TreePoint>& growth);  ///< build time against triangles
Chart steps_chart(const std::vector<TreePoint>& growth);   ///< nodes and tests against triangles
Chart leaves_chart(const std::vector<LeafPoint>& leaves);  ///< time against nodes per triangle
Chart accuracy_chart(const std::vector<AccuracyPoint>& accuracy);  ///< time against wrong answers

/// H13, P2, P6, P7, O9, O10 and O15.
std::vector<ClaimAnswer> answer_claims(const TreeMeasurements& measured);

/// Counts; times too, where they mean something.
void print_trees(const std::vector<TreePoint>& trees, bool times);
void print_growth(const std::vector<TreePoint>& growth, bool times);
void print_leaves(const std::vector<LeafPoint>& leaves, bool times);
void print_heuristics(const TreeMeasurements& measured, bool times);
void print_answers(const TreeMeasurements& measured, bool times);
void print_phases(const std::vector<PhasePoint>& phases);

/// What the text quotes; times where there are any.
void quote_trees(const TreeMeasurements& measured, bool times, Numbers& numbers);

}  // namespace space::ch07
