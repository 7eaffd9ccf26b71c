/// @file
/// The parts of measuring schedules.
#pragma once

#include "chapters/ch08_parallel_builds/measured/schedule_data.hpp"
#include "chapters/ch08_parallel_builds/schedule.hpp"
#include "chapters/ch08_parallel_builds/task_graph.hpp"
#include "common/geometry.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch08 {

/// A scene with what its build has to do.
struct RecordedBuild {
    std::string scene;
    std::vector<Triangle> triangles;
    TaskGraph graph = {};
    double scaled = 1.0;  ///< what recorded times were multiplied by
};

/// A method by the name that tables use.
struct NamedMethod {
    std::string_view name;
    ParallelMethod method;
};
std::vector<NamedMethod> compared_methods(bool small);  ///< published ones and ours
std::vector<NamedMethod> condition_methods();           ///< the queue by each condition

/// Times dividing the work: threads, lock, loops; bytes by this build.
MeasuredCosts measure_costs(const RecordedBuild& build, int rounds);
SchedulingCosts scheduling_costs(const MeasuredCosts& costs, bool has_bandwidth);

/// The published methods and ours by 1 and 2 threads, measured and simulated; once
/// what is the same: all published ones by 1 thread, and the first two by 2.
std::vector<ValidationPoint> validate(const RecordedBuild& build, const SchedulingCosts& costs,
                                      int rounds);

}  // namespace space::ch08
