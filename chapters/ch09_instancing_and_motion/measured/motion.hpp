/// @file
/// Refits, rotations and rebuilds of trees whose triangles move, and a crowd: claim O11.
#pragma once

#include "chapters/ch09_instancing_and_motion/measured/motion_data.hpp"
#include "common/geometry.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace space::ch09 {

MotionMeasurements measure_motion(const Options& options);

/// References in the nodes that the binned builder cuts: what its work is in proportion to.
std::uint64_t binned_references(std::span<const Triangle> triangles);

/// The parts, of which charts show some.
std::vector<RefitPoint> measure_refits(const Options& options);
std::vector<FramePoint> measure_frames(const Options& options);
std::vector<PolicyPoint> measure_policies(const Options& options);
std::vector<CrowdPoint> measure_crowd(const Options& options);

void print_motion(const MotionMeasurements& measured, bool times);
void quote_motion(const MotionMeasurements& measured, bool times, Numbers& numbers);
/// Answers that are not those of a tree that is built anew.
std::uint64_t wrong_motion(const MotionMeasurements& measured);
/// O11.
std::vector<ClaimAnswer> answer_motion(const MotionMeasurements& measured);

Chart motion_frames_chart(const std::vector<FramePoint>& frames);
Chart motion_policies_chart(const std::vector<PolicyPoint>& policies);
Chart motion_refits_chart(const std::vector<RefitPoint>& refits);

}  // namespace space::ch09
