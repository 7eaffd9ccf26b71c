/// @file
/// Exercise 3.3, a near miss: whoever is not in front is taken to be behind, also the splitter
/// itself and what lies on its line.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <cmath>
#include <limits>
#include <span>

namespace space {

/// Exercise 3.1 in the plane.
inline PlaneSide classify(const Segment& segment, const SplitPlane<2>& line) {
    const double a = line.distance(Double2(segment.a));
    const double b = line.distance(Double2(segment.b));
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) return PlaneSide::straddling;
    return a > 0.0 || b > 0.0   ? PlaneSide::front
           : a < 0.0 || b < 0.0 ? PlaneSide::back
                                : PlaneSide::coplanar;
}

inline std::size_t choose_splitter(std::span<const Segment> set,
                                   std::span<const std::size_t> candidates, double split_weight) {
    std::size_t best = candidates[0];
    double best_cost = std::numeric_limits<double>::infinity();
    for (const std::size_t candidate : candidates) {
        const SplitPlane<2> line(set[candidate]);
        double front = 0.0, back = 0.0, cuts = 0.0;
        for (const Segment& segment : set) {
            switch (classify(segment, line)) {
                case PlaneSide::front:
                    ++front;
                    break;
                case PlaneSide::straddling:
                    ++cuts;
                    break;
                default:
                    ++back;
                    break;
            }
        }
        const double cost = std::abs(front - back) + split_weight * cuts;
        if (cost >= best_cost) continue;
        best = candidate;
        best_cost = cost;
    }
    return best;
}

}  // namespace space
