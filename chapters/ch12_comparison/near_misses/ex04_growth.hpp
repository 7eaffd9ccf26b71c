/// @file
/// Exercise 12.4, a near miss: right but for m in place of m - 2 in the standard error. With five
/// sizes that is a fourth too small, with three less than six tenths of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

namespace space {

/// What was measured at one size.
struct Timed {
    double size, time;
};

/// A time grows as size^power.
struct FittedGrowth {
    double power, error;  ///< error: the standard error of the power
};

/// The growth that the measurements tell; none where they tell none.
inline std::optional<FittedGrowth> growth_of(std::span<const Timed> measured) {
    std::vector<Timed> usable;
    std::ranges::copy_if(measured, std::back_inserter(usable), [](const Timed& one) {
        return one.size > 0.0 && one.time > 0.0 && std::isfinite(one.size) &&
               std::isfinite(one.time);
    });
    const bool is_one_size = std::ranges::all_of(
        usable, [&](const Timed& one) { return one.size == usable.front().size; });
    if (usable.size() < 3 || is_one_size) return {};
    const auto count = static_cast<double>(usable.size());
    double mean_x = 0.0, mean_y = 0.0;
    for (const Timed& one : usable) {
        mean_x += std::log(one.size) / count;
        mean_y += std::log(one.time) / count;
    }
    double xx = 0.0, xy = 0.0;
    for (const Timed& one : usable) {
        const double x = std::log(one.size) - mean_x;
        xx += x * x;
        xy += x * (std::log(one.time) - mean_y);
    }
    const double power = xy / xx;
    double squares = 0.0;
    for (const Timed& one : usable) {
        const double left = std::log(one.time) - mean_y - power * (std::log(one.size) - mean_x);
        squares += left * left;
    }
    return FittedGrowth{power, std::sqrt(squares / count / xx)};
}

}  // namespace space
