/// @file
/// Measuring: a stopwatch, medians of interleaved runs, and the growth exponent of a series.
/// Times are for charts and tables; no test asserts one.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace space {

struct Options;

using Milliseconds = std::chrono::duration<double, std::milli>;

/// Real time, by a clock that is never set back.
class Stopwatch {
  public:
    /// Time since construction or the last lap.
    Milliseconds lap() {
        const auto now = std::chrono::steady_clock::now();
        const Milliseconds elapsed = now - start_;
        start_ = now;
        return elapsed;
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The middle value (mean of the two middle ones for an even count); NaN for none.
inline double median(std::vector<double> values) {
    if (values.empty()) return std::nan("");
    const std::size_t middle = values.size() / 2;
    std::sort(values.begin(), values.end());
    return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// Runs the candidates in turn, A B C A B C ..., after one round of warming up, and returns each
/// one's median time in milliseconds. Taking turns spreads the machine's moods over all of them, so
/// the ratios hold.
inline std::vector<double> interleaved_medians(std::span<const std::function<void()>> candidates,
                                               int rounds) {
    std::vector<std::vector<double>> times(candidates.size());
    for (const auto& run : candidates) run();
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            Stopwatch stopwatch;
            candidates[i]();
            times[i].push_back(stopwatch.lap().count());
        }
    std::vector<double> medians;
    for (auto& series : times) medians.push_back(median(std::move(series)));
    return medians;
}

/// The least-squares slope of log y over log x: 1 for linear growth, 2 for quadratic, near 0 for
/// none. All values must be positive; needs two different x.
inline double log_log_slope(std::span<const double> x, std::span<const double> y) {
    const auto n = static_cast<double>(x.size());
    double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double lx = std::log(x[i]), ly = std::log(y[i]);
        sum_x += lx;
        sum_y += ly;
        sum_xx += lx * lx;
        sum_xy += lx * ly;
    }
    return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

/// Keeps the compiler from dropping a computation whose result nobody reads.
template <class T>
void do_not_optimize(const T& value) {
    asm volatile("" : : "r,m"(value) : "memory");
}

/// What measure(options) returns, measured the first time only: tables, claims and charts of one
/// program show the same run.
template <auto measure>
const auto& measured_once(const Options& options) {
    static const auto result = measure(options);
    return result;
}

}  // namespace space
