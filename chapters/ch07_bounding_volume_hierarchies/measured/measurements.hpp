/// @file
/// What chapter 7's program counts and times of trees.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/measured/data.hpp"
#include "common/program/options.hpp"

#include <cstddef>
#include <vector>

namespace space::ch07 {

/// How far measurements go.
struct Limits {
    int width, height;           ///< of the cameras' pictures
    std::size_t most_triangles;  ///< of growing scenes
    std::size_t aimed_rays;
    std::uint64_t naive_tests;  ///< that may be spent on true answers for one tree's rays
    int rounds;                 ///< of timed runs; 0: none
};
Limits limits(const Options& options);

/// All builders on all scenes, Embree among them where it is installed and times are taken.
std::vector<TreePoint> measure_trees(const Options& options);
std::vector<TreePoint> measure_growth(const Options& options);
std::vector<LeafPoint> measure_leaves(const Options& options);
std::vector<CandidatePoint> measure_candidates(const Options& options);
std::vector<SumPoint> measure_sums(const Options& options);
std::vector<WalkPoint> measure_walks(const Options& options);
/// Spatial splits with other limits; builders from the leaves up.
std::vector<VariantPoint> measure_spatial(const Options& options);
std::vector<VariantPoint> measure_from_below(const Options& options);
std::vector<AccuracyPoint> measure_accuracy(const Options& options);
std::vector<ExactPoint> measure_exact(const Options& options);
/// Times alone.
std::vector<PhasePoint> measure_phases(const Options& options);

}  // namespace space::ch07
