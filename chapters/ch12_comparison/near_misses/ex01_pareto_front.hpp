/// @file
/// Exercise 12.1, a near miss: sorted by build time, each that is traced faster than all before it.
/// That is quick, and right but for twins: of two with the same times the second is left out.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <tuple>
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
    std::vector<std::size_t> standing, front;
    for (std::size_t i = 0; i < structures.size(); ++i)
        if (!std::isnan(structures[i].build_ms) && !std::isnan(structures[i].trace_ns))
            standing.push_back(i);
    std::ranges::stable_sort(standing, {}, [&](std::size_t i) {
        return std::tuple(structures[i].build_ms, structures[i].trace_ns);
    });
    double fastest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : standing)
        if (structures[i].trace_ns < fastest) {
            fastest = structures[i].trace_ns;
            front.push_back(i);
        }
    return front;
}

}  // namespace space
