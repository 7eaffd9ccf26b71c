/// @file
/// Axes of charts: their ranges, and where ticks stand and what they say.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace space {

/// A value that has its name beside an axis.
struct Tick {
    double value;
    std::string text;
};

/// One axis: its range, its ticks, and where on it a value lies.
struct Axis {
    bool logarithmic = false;
    double low = 0.0, high = 1.0;
    std::vector<Tick> ticks = {};

    /// 0 at the low end, 1 at the high end.
    double fraction(double value) const;
};

/// 25000 -> "25 K", where the axis reaches 10,000 or more.
std::string tick_text(double value, double largest);

/// Of positive values, with room at both ends, a part of what lies between; every third decade has
/// a tick where all are too many.
Axis log_axis(double least, double most, std::size_t most_ticks = 8, double room = 0.05);

/// From zero, where no value is negative, to at least `headroom` steps above the largest.
Axis linear_axis(double least, double most, double headroom = 0.0);

}  // namespace space
