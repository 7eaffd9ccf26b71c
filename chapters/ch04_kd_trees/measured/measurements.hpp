/// @file
/// What chapter 4's program counts and times.
#pragma once

#include "chapters/ch04_kd_trees/measured/data.hpp"
#include "chapters/ch04_kd_trees/measured/point_measurements.hpp"
#include "common/program/options.hpp"

namespace space::ch04 {

/// How far measurements go.
struct Limits {
    int width, height;  ///< of the cures' pictures
    std::size_t sizes;  ///< of each growing scene: half decades from 1,000
    std::size_t rays, aimed_rays;
    int rounds;  ///< of timed runs
};
Limits limits(const Options& options);

/// Lichter23's tree, cure by cure, on four scenes.
std::vector<CurePoint> measure_cures(const Options& options);
/// Trees of --scene and of some more by all rules.
std::vector<TreePoint> measure_trees(const Options& options);
std::vector<Growth> measure_growth(const Options& options);
std::vector<CarePoint> measure_care(const Options& options);
/// CATALOGUE K1 and K2: four sizes of triangles.
std::vector<OverlapPoint> measure_overlaps(const Options& options);
std::vector<PlaneTimes> measure_planes(const Options& options);

}  // namespace space::ch04
