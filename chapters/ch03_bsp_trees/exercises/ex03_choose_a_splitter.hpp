/// @file
/// Exercise 3.3: Choose a splitter
/// Difficulty 2 of 3, about 25 minutes.
///
/// A good splitter parts its set in the middle and cuts few. Of the candidates, which are indices
/// into the set, return the one with the lowest cost: the difference between the number of segments
/// in front and behind, plus `split_weight` for each segment that the candidate's line cuts. What
/// lies on the line, such as the candidate itself, costs nothing; what only touches it is not cut.
/// Of equal costs the earlier candidate counts. There is at least one candidate. Checked on
/// Heinonen's segments *A* to *G*, and on random sets with small whole coordinates, where many
/// touch and coincide.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

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
    // TODO: the first candidate gives a right tree, but seldom a small one
    static_cast<void>(set);
    static_cast<void>(split_weight);
    return candidates[0];
}

}  // namespace space
