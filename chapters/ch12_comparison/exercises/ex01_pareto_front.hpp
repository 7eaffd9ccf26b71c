/// @file
/// Exercise 12.1: The front of a Pareto chart
/// Difficulty 1 of 3, about 25 minutes.
///
/// One structure is built soon, another is traced fast, and how many rays there will be decides
/// between them. But a structure that another one *beats* is the best for nobody. One beats another
/// if it is at least as good in both times, and better in one of them. What no other one beats is
/// the *Pareto front*: in a chart of build time against tracing time, the lower left edge.
///
/// Two structures with the same two times do not beat each other: if one is on the front, so is the
/// other. A structure that gave up has no times; one of them, or both, is NaN. It is not on the
/// front, and beats nobody.
///
/// The check does not mind how long it takes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace space {

/// A structure in the chart.
struct BuildAndTrace {
    double build_ms;  ///< NaN where it gave up
    double trace_ns;  ///< of a ray; NaN where it gave up
};

/// The places in `structures` of those on the front, from the shortest build to the longest; those
/// with the same times in the order in which they stand.
inline std::vector<std::size_t> pareto_front(std::span<const BuildAndTrace> structures) {
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < structures.size(); ++i)
        front.push_back(i);  // TODO: not all of them
    return front;
}

}  // namespace space
