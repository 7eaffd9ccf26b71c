/// @file
/// Who works when while four methods build the same tree.
#pragma once

#include "chapters/ch08_parallel_builds/schedule.hpp"
#include "chapters/ch08_parallel_builds/task_graph.hpp"
#include "common/geometry.hpp"
#include "common/program/svg.hpp"

#include <array>
#include <span>
#include <string_view>

namespace space::ch08 {

/// A build of these triangles, in nanoseconds, about as on our machine: from a formula for a node's
/// cost.
TaskGraph formula_graph(std::span<const Triangle> triangles);

/// What dividing a build costs there, in nanoseconds.
inline constexpr SchedulingCosts formula_costs{
    .thread_start = 15e3, .lock = 100.0, .steal = 2e3, .chunk = 1e3, .serial_share = 0.05};

/// The same build by a method.
struct DrawnSchedule {
    std::string_view name;
    Schedule schedule;
};
/// By the thesis' three methods and by work stealing. At least one core.
std::array<DrawnSchedule, 4> four_schedules(const TaskGraph& graph, unsigned cores,
                                            const SchedulingCosts& costs);

/// Below each other, with one axis of time for all. Up to 16 cores.
Svg drawn_methods(const TaskGraph& graph, const std::array<DrawnSchedule, 4>& schedules);

}  // namespace space::ch08
