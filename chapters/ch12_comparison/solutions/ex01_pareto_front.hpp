/// @file
/// Exercise 12.1, a solution: the definition, for each against each.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace space {

/// A structure in the chart.
struct BuildAndTrace {
    double build_ms;  ///< NaN where it gave up
    double trace_ns;  ///< of a ray; NaN where it gave up
};

/// At least as good in both, and better in one; false where a time is NaN.
inline bool beats(const BuildAndTrace& a, const BuildAndTrace& b) {
    return a.build_ms <= b.build_ms && a.trace_ns <= b.trace_ns &&
           (a.build_ms < b.build_ms || a.trace_ns < b.trace_ns);
}

/// The places in `structures` of those on the front, from the shortest build to the longest; those
/// with the same times in the order in which they stand.
inline std::vector<std::size_t> pareto_front(std::span<const BuildAndTrace> structures) {
    std::vector<std::size_t> front;
    for (std::size_t i = 0; i < structures.size(); ++i) {
        const BuildAndTrace& one = structures[i];
        const bool stands = !std::isnan(one.build_ms) && !std::isnan(one.trace_ns);
        if (stands && std::ranges::none_of(structures, [&](const BuildAndTrace& other) {
                return beats(other, one);
            }))
            front.push_back(i);
    }
    std::ranges::stable_sort(front, {}, [&](std::size_t i) { return structures[i].build_ms; });
    return front;
}

}  // namespace space
