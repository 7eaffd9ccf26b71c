/// @file
/// Exercise 8.4: Amdahl by hand
/// Difficulty 2 of 3, about 30 minutes.
///
/// A program took 10 s with two threads and 7 s with four. How much of it is serial, and how fast
/// can it become? Amdahl's model says that *n* threads take *T*(*n*) = *s* + *w* / *n*: the serial
/// part *s* and the rest *w*, evenly divided. Two times, with different numbers of threads, give
/// both. Neither of them needs to be that of one thread.
///
/// Then answer what one wants to know: how many times faster *n* threads are than one, what no
/// number of them exceeds, and how many are needed at least for a speed-up that is asked for. Two
/// measured times may be such that no model fits: a part would be negative.
///
/// The check takes times that binary numbers hold exactly, and holds the answers against each
/// other for many models. The bound of a program without a serial part is infinity.
#pragma once

#include <cstdint>
#include <limits>
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
    // TODO: two equations, two unknowns
    static_cast<void>(b);
    return AmdahlModel{0.0, a.seconds * a.threads};
}

/// How many times faster so many threads are than one.
inline double modelled_speedup(const AmdahlModel& model, double threads) {
    // TODO: the serial part stays
    static_cast<void>(model);
    return threads;
}

/// What no number of threads exceeds.
inline double largest_speedup(const AmdahlModel& model) {
    // TODO: what is left of the time where n is beyond all bounds?
    static_cast<void>(model);
    return std::numeric_limits<double>::infinity();
}

/// The least number of threads that are at least `speedup` times faster than one, for a speed-up
/// greater than 0; nothing where no number is.
inline std::optional<std::uint64_t> threads_for(const AmdahlModel& model, double speedup) {
    // TODO: solve for n, and mind where no n does it
    static_cast<void>(model);
    return static_cast<std::uint64_t>(speedup);
}

}  // namespace space
