/// @file
/// Exercise 12.4: How fast does it grow?
/// Difficulty 2 of 3, about 35 minutes.
///
/// A time *y* that was measured for several sizes *n* is said to grow as c n^p. In logarithms that
/// is a straight line, log y = log c + p log n. Its slope *p* is that of the line with the least
/// sum of squares: every measurement counts, not the smallest and the largest alone.
///
/// Times scatter, so *p* is not known exactly. Its *standard error* says how well: with x = log n,
/// the root of s^2 over the sum of (x - mean of x)^2. Here s^2 is the sum of the squares of what
/// the line leaves of log y, over *m* - 2 for *m* measurements: through two points there is always
/// a line, and says nothing about how they scatter.
///
/// A measurement whose size or time is not a positive, finite number is left out (a structure that
/// gave up has NaN). Of fewer than three measurements, or if all have the same size, there is no
/// answer.
#pragma once

#include <optional>
#include <span>

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
    if (measured.size() < 3) return {};
    return FittedGrowth{1.0, 0.0};  // TODO: what everybody hopes for
}

}  // namespace space
