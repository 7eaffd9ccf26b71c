/// @file
/// Exercise 3.3, solution.
#pragma once

#include "chapters/ch03_bsp_trees/fragment.hpp"

#include <cmath>
#include <limits>
#include <span>

namespace space {

/// Exercise 3.1 in the plane.
inline Side classify(const Segment& segment, const SplitPlane<2>& line) {
    const double a = line.distance(DoublePoint<2>(segment.a));
    const double b = line.distance(DoublePoint<2>(segment.b));
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) return Side::across;
    return a > 0.0 || b > 0.0 ? Side::front : a < 0.0 || b < 0.0 ? Side::back : Side::on;
}

inline std::size_t choose_splitter(std::span<const Segment> set,
                                   std::span<const std::size_t> candidates, double split_weight) {
    std::size_t best = candidates[0];
    double best_price = std::numeric_limits<double>::infinity();
    for (const std::size_t candidate : candidates) {
        const SplitPlane<2> line(corners(set[candidate]));
        double front = 0.0, back = 0.0, cuts = 0.0;
        for (const Segment& segment : set) {
            const Side side = classify(segment, line);
            front += side == Side::front;
            back += side == Side::back;
            cuts += side == Side::across;
        }
        const double price = std::abs(front - back) + split_weight * cuts;
        if (price >= best_price) continue;
        best = candidate;
        best_price = price;
    }
    return best;
}

}  // namespace space
