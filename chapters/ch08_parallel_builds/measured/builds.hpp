/// @file
/// Table 3 of [BvhThesis13] anew, how builds grow, what two threads can gain at all, and
/// build time against the tree's quality: claim P8.
#pragma once

#include "chapters/ch08_parallel_builds/measured/build_data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <vector>

namespace space::ch08 {

std::vector<SamePoint> measure_same_trees(const Options& options);
/// Times alone. Scenes that this machine does not have are left out, with a message.
SceneBuilds measure_scenes(const Options& options);
std::vector<BuildPoint> measure_build_growth(const Options& options);
BuildMeasurements measure_builds(const Options& options);

void print_builds(const BuildMeasurements& measured, bool times);
void quote_builds(const BuildMeasurements& measured, bool times, Numbers& numbers);
/// P8.
std::vector<ClaimAnswer> answer_builds(const BuildMeasurements& measured);

Chart gains_chart(const std::vector<BuildPoint>& scenes);    ///< 2 threads against 1, by scene
Chart quality_chart(const std::vector<BuildPoint>& scenes);  ///< build time against cost
Chart build_growth_chart(const std::vector<BuildPoint>& growth);

}  // namespace space::ch08
