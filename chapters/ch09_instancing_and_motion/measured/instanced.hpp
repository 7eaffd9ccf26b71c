/// @file
/// Exact instancing beside the usual way: answers that differ, and what both cost.
#pragma once

#include "chapters/ch09_instancing_and_motion/measured/instanced_data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"

#include <cstdint>
#include <vector>

namespace space::ch09 {

/// Every way with every triangle test, near the origin and far from it.
std::vector<AccuracyPoint> measure_accuracy(const Options& options);
/// Two levels beside the flattened mesh's tree.
std::vector<LevelsPoint> measure_levels(const Options& options);
InstancedMeasurements measure_instanced(const Options& options);

void print_instanced(const InstancedMeasurements& measured, bool times);
void quote_instanced(const InstancedMeasurements& measured, bool times, Numbers& numbers);
/// Answers by world triangles that are not those of the flattened mesh: of each test where that
/// test is exact.
std::uint64_t wrong_instanced(const InstancedMeasurements& measured);

Chart accuracy_chart(const std::vector<AccuracyPoint>& accuracy);
Chart away_chart(const std::vector<AccuracyPoint>& accuracy);
Chart levels_chart(const std::vector<LevelsPoint>& levels);

}  // namespace space::ch09
