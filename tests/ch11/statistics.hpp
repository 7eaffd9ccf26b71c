/// @file
/// What the tests of estimators share: means with their errors, histograms against densities. With
/// fixed seeds they are exact repetitions; the limits say how rarely a right estimator would fail
/// with another seed.
#pragma once

#include "common/geometry.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace space {

/// Mean and variance of numbers, one after the other (Welford 1962).
class Mean {
  public:
    void add(double x) {
        ++count_;
        const double difference = x - mean_;
        mean_ += difference / static_cast<double>(count_);
        squares_ += difference * (x - mean_);
    }
    double mean() const { return mean_; }
    /// Of the numbers.
    double variance() const { return squares_ / static_cast<double>(count_ - 1); }
    /// The mean's standard deviation.
    double error() const { return std::sqrt(variance() / static_cast<double>(count_)); }
    /// Whether the exact value is within five standard deviations of the mean (of a million right
    /// ones not one is farther), or within rounding where all numbers are the same.
    bool agrees_with(double exact, double rounding = 1e-12) const {
        return std::abs(mean_ - exact) <= 5.0 * error() + rounding * std::abs(exact);
    }

  private:
    std::size_t count_ = 0;
    double mean_ = 0.0, squares_ = 0.0;
};

/// Pearson's sum over cells. Where nothing is expected, nothing may be observed: infinite then.
inline double chi_square(std::span<const std::uint64_t> observed,
                         std::span<const double> expected) {
    double sum = 0.0;
    for (std::size_t i = 0; i < observed.size(); ++i) {
        const double difference = static_cast<double>(observed[i]) - expected[i];
        if (difference != 0.0) sum += difference * difference / expected[i];
    }
    return sum;
}

/// What a chi-square variable with cells - 1 degrees of freedom exceeds at most once in a million
/// (Laurent & Massart 2000, lemma 1: k + 2 sqrt(k x) + 2 x with probability at most e^-x).
inline double chi_square_limit(std::size_t cells) {
    const double k = static_cast<double>(cells) - 1.0, x = std::log(1e6);
    return k + 2.0 * std::sqrt(k * x) + 2.0 * x;
}

}  // namespace space
