/// @file
/// Exercise 8.4, our answer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace space {

/// A run.
struct TimedRun {
    unsigned threads;
    double seconds;
};

/// T(n) = serial + divided / n, in seconds. No part is negative, and one of them is positive.
struct AmdahlModel {
    double serial, divided;
};

/// From two runs with different numbers of threads; nothing where a part would be negative.
inline std::optional<AmdahlModel> fitted_model(const TimedRun& a, const TimedRun& b) {
    const double p = a.threads, q = b.threads;
    // Without reciprocals, which would round: w (q - p) / (p q) = T(p) - T(q).
    const double divided = (a.seconds - b.seconds) * p * q / (q - p);
    const double serial = (a.seconds * p - b.seconds * q) / (p - q);
    if (divided < 0.0 || serial < 0.0) return std::nullopt;
    return AmdahlModel{serial, divided};
}

/// How many times faster so many threads are than one.
inline double modelled_speedup(const AmdahlModel& model, double threads) {
    return (model.serial + model.divided) / (model.serial + model.divided / threads);
}

/// What no number of threads exceeds.
inline double largest_speedup(const AmdahlModel& model) {
    return (model.serial + model.divided) / model.serial;
}

/// The least number of threads that are at least `speedup` times faster than one, for a speed-up
/// greater than 0; nothing where no number is.
inline std::optional<std::uint64_t> threads_for(const AmdahlModel& model, double speedup) {
    if (speedup <= 1.0) return 1;
    const double left = (model.serial + model.divided) / speedup - model.serial;
    if (left <= 0.0) return std::nullopt;
    auto n = static_cast<std::uint64_t>(std::max(1.0, std::ceil(model.divided / left)));
    const auto does = [&](std::uint64_t threads) {
        return modelled_speedup(model, double(threads)) >= speedup;
    };
    while (n > 1 && does(n - 1)) --n;
    while (!does(n)) ++n;
    return n;
}

}  // namespace space
