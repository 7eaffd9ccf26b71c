/// @file
/// Parallel builds on machines that are not here: events in the order of their times.
#pragma once

#include "chapters/ch08_parallel_builds/schedule.hpp"
#include "chapters/ch08_parallel_builds/task_graph.hpp"

namespace space {

/// The build of a graph on so many cores, at least one, a thread on each. Of what happens at the
/// same time the core with the lower number comes first: the same schedule on every machine.
/// @throws std::invalid_argument for no core, and for costs that are negative or not finite
Schedule simulate(const TaskGraph& graph, const ParallelMethod& method, unsigned cores,
                  const SchedulingCosts& costs = {});

}  // namespace space
