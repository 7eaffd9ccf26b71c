/// @file
/// Our build, step by step: all cores at the large nodes, then tasks that idle cores steal.
#pragma once

#include "chapters/ch08_parallel_builds/schedule.hpp"
#include "chapters/ch08_parallel_builds/task_graph.hpp"
#include "common/program/svg.hpp"

namespace space::ch08 {

/// What figure 8.15 shows first. Three cores; to steal takes two units.
inline constexpr ParallelMethod stealing_method{
    .kind = ParallelMethod::Kind::stealing, .large = 12, .chunk = 6, .grain = 2};
inline constexpr unsigned stealing_cores = 3;
inline constexpr double stealing_cost = 2.0;

/// A tree of 16 segments, built by two to eight cores that steal. Its levels, at most
/// seven, stand above the bars of the cores.
Svg drawn_stealing(const TaskGraph& graph, const Schedule& schedule);

}  // namespace space::ch08
