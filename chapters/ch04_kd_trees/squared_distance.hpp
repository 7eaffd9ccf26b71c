/// @file
/// Which of two points is nearer to a third, in three grades of care: floats leave out what is
/// certainly too far, doubles decide nearly all of the rest, expansions what is too close for them.
#pragma once

#include "chapters/ch02_intersection_tests/expansion.hpp"
#include "common/geometry.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

namespace space {

/// A point that a search found.
struct Neighbour {
    std::uint32_t index;  ///< among the points that the tree was built of
    /// As `squared_distance` gives it, within squared_distance_bound of the true one. The order of
    /// neighbours is that of the true distances.
    double squared_distance;

    bool operator==(const Neighbour&) const = default;
};

// [squared_distance]
/// In double, which neither overflows nor underflows: a difference of floats is 0 or between 2^-149
/// and 2^129.
template <int D>
double squared_distance(const Point<D>& p, const Point<D>& q) {
    const Double<D> difference = Double<D>(p) - Double<D>(q);
    return glm::dot(difference, difference);
}
// [squared_distance]

/// Roundings in a term of the sum, at most: its difference's, which the square has twice, the
/// product's, and D - 1 of sums (0 + x is exact). No term is negative, so the sum is wrong by no
/// larger a factor than its worst term: with u53 = 2^-53 it lies between (1 - u53)^n and (1 +
/// u53)^n times the true one, n = D + 2.
template <int D>
constexpr int distance_roundings = D + 2;

/// The largest error of squared_distance, as a part of the true one: n u53, and one u53 more for
/// the higher powers.
template <int D>
constexpr double squared_distance_bound = (distance_roundings<D> + 1) * 0x1p-53;

/// Whether a < b is certain of two true values, known within squared_distance_bound. Each may be
/// off by n u53; then come the product's own rounding and the higher powers of u53, less than one
/// u53 each.
template <int D>
bool certainly_less(double a, double b) {
    return a * (1.0 + (2 * distance_roundings<D> + 2) * 0x1p-53) < b;
}

/// Whether squared_distance has rounded nothing, as on a grid: each difference is exact and fits a
/// float, so that its square fits a double, and so does each sum.
template <int D>
bool is_squared_distance_exact(const Point<D>& p, const Point<D>& q) {
    double sum = 0.0;
    for (int axis = 0; axis < D; ++axis) {
        const auto [d, low] = two_sum(p[axis], -static_cast<double>(q[axis]));
        if (low != 0.0 || std::abs(d) > std::numeric_limits<float>::max() ||
            static_cast<double>(static_cast<float>(d)) != d)
            return false;
        const auto [total, rest] = two_sum(sum, d * d);
        if (rest != 0.0) return false;
        sum = total;
    }
    return true;
}

/// Without any rounding.
template <int D>
Expansion<8 * D> exact_squared_distance(const Point<D>& p, const Point<D>& q) {
    const auto square = [&](int axis) {
        const Expansion<2> d = difference(p[axis], q[axis]);
        return d * d;
    };
    if constexpr (D == 2)
        return square(0) + square(1);
    else
        return square(0) + square(1) + square(2);
}

// [reach]
/// A float distance: the sum of squares in float, axis by axis. With u24 = 2^-24 it lies between (1
/// - u24)^n and (1 + u24)^n times the true one, or up to D 2^-150 < 2^-148 beyond where squares
/// underflow; an overflow gives infinity, which every reach below may be.

/// Up to this float distance a point may be one of those within `squared` (in double).
/// Rounding the reach to float takes one u24, or 2^-150.
template <int D>
float float_reach(double squared) {
    const double reach = squared * (1.0 + (distance_roundings<D> + 2) * 0x1p-24) + 0x1p-146;
    return reach < std::numeric_limits<float>::max() ? static_cast<float>(reach) : infinity;
}

/// Up to this float distance a point may in truth be no farther than one whose float distance is
/// `distance`. Either may be off by n u24 and 2^-148; two u24 more for the roundings here and the
/// higher powers.
template <int D>
float unsure_up_to(float distance) {
    return distance * (1.0f + (2 * distance_roundings<D> + 4) * 0x1p-24f) + 0x1p-146f;
}
// [reach]

}  // namespace space
