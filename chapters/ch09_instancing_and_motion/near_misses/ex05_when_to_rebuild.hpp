/// @file
/// Exercise 9.5, a near miss: the period whose frames cost least on average. That is right for an
/// animation without end; in one that ends, the last tree may serve a few frames only.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace space {

inline std::size_t best_period(double build, double refit, std::span<const double> rays) {
    double least = std::numeric_limits<double>::infinity(), total = build - refit;
    std::size_t best = 0;
    for (std::size_t period = 1; period <= rays.size(); ++period) {
        total += refit + rays[period - 1];
        if (total / double(period) <= least) {
            least = total / double(period);
            best = period;
        }
    }
    return best;
}

}  // namespace space
