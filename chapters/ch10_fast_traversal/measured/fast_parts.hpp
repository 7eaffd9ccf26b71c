/// @file
/// The parts of measure_fast, each in a file of its own.
#pragma once

#include "chapters/ch10_fast_traversal/measured/data.hpp"
#include "chapters/ch10_fast_traversal/measured/effort.hpp"
#include "chapters/ch10_fast_traversal/measured/traced_scene.hpp"
#include "chapters/ch10_fast_traversal/ray_bound.hpp"
#include "common/program/options.hpp"
#include "common/program/report.hpp"

#include <vector>

namespace space::ch10 {

/// memory, slabs, steps.
void measure_probes(const FastEffort& effort, FastMeasurements& measured);
/// What the probes say of this machine; all 0 where nothing was timed.
MachineCosts machine_costs(const FastMeasurements& measured);

/// What a ray of each kind does in a scene's trees, by the model of caches; and the bounds.
void measure_work(const TracedScene& scene, const FastEffort& effort, FastMeasurements& measured);
/// The ladder on one scene.
void measure_ladder(const TracedScene& scene, const Options& options, FastMeasurements& measured);
/// Ours beside Embree on one scene; their builds.
void measure_peers(const TracedScene& scene, const Options& options, FastMeasurements& measured);
/// Widths, leaf sizes, better binary trees.
void measure_choices(const TracedScene& scene, const FastEffort& effort,
                     FastMeasurements& measured);
/// What was tried to build faster, and to share rays between two threads.
void measure_cures(const TracedScene& scene, const FastEffort& effort, FastMeasurements& measured);
/// Ways to trace several rays at once.
void measure_modes(const TracedScene& scene, const FastEffort& effort, FastMeasurements& measured);
/// Where a ray's time goes; what was tried where a goal is missed, from all that was timed.
Table profile_table(const std::vector<WorkPoint>& work);
Table cures_table(const FastMeasurements& measured);
/// One scene as it grows.
void measure_sizes(const Options& options, FastMeasurements& measured);
/// Rays at edges and vertices; kernels beside the naive loop.
void measure_aimed(const Options& options, FastMeasurements& measured);

}  // namespace space::ch10
