/// @file
/// Exercise 9.5, our answer.
#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace space {

inline std::size_t best_period(double build, double refit, std::span<const double> rays) {
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t period = 1; period <= rays.size(); ++period) {
        double total = 0.0;
        for (std::size_t frame = 0; frame < rays.size(); ++frame) {
            const std::size_t age = frame % period;
            total += rays[age] + (age == 0 ? build : refit);
        }
        if (total <= least) {
            least = total;
            best = period;
        }
    }
    return best;
}

}  // namespace space
