/// @file
/// Times with their spread: medians of interleaved runs between quartiles, and gains that are
/// ratios of times of the same round, so that the machine's moods are in both.
#pragma once

#include "common/measure.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace space::ch08 {

/// The middle of some values, and what half of them lie between.
struct Spread {
    double median = 0.0, low = 0.0, high = 0.0;
};

inline Spread spread_of(std::vector<double> values) {
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * double(values.size() - 1) + 0.5)];
    };
    return values.empty() ? Spread{} : Spread{median(values), at(0.25), at(0.75)};
}

/// Times in milliseconds, by round.
using Times = std::vector<double>;

/// Runs the candidates in turn, after one round of warming up.
inline std::vector<Times> interleaved_times(std::span<const std::function<void()>> candidates,
                                            int rounds) {
    std::vector<Times> times(candidates.size());
    for (int round = -1; round < rounds; ++round)
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            Stopwatch stopwatch;
            candidates[i]();
            const double ms = stopwatch.lap().count();
            if (round >= 0) times[i].push_back(ms);
        }
    return times;
}

/// One candidate's times over another's, round by round.
inline Spread ratio(const Times& over, const Times& under) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < over.size(); ++i) ratios.push_back(over[i] / under[i]);
    return spread_of(std::move(ratios));
}

}  // namespace space::ch08
