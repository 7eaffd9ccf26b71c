/// @file
/// What tables, charts and the verdict make of timed builds.
#pragma once

#include "chapters/ch08_parallel_builds/measured/build_data.hpp"
#include "common/program/numbers.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch08 {

/// The scenes in their order, each once.
std::vector<std::string> scenes_of(const std::vector<BuildPoint>& points);

/// One scene, and what the chapter wants of it.
struct BuildGoal {
    std::string scene;
    Spread one, two;                      ///< gains of ours with 1 and with 2 threads
    std::optional<double> beside_embree;  ///< ours with 2 threads over Embree's time

    bool is_twice() const { return two.median >= 1.9; }
    /// Nobody can tell times from each other that differ by less than their spread.
    bool is_not_slower() const { return one.high >= 1.0; }
    bool is_near_embree() const { return beside_embree && *beside_embree <= 1.2; }
};
std::vector<BuildGoal> build_goals(const std::vector<BuildPoint>& scenes);

/// A builder over all scenes: medians of its time and its tree's cost beside the sequential one.
struct QualityPoint {
    std::string_view method;
    unsigned threads;
    std::size_t scenes;
    double time, cost;
};
std::vector<QualityPoint> qualities(const std::vector<BuildPoint>& scenes);

/// The exponent of n in a method's build time.
double growth_slope(const std::vector<BuildPoint>& growth, std::string_view method,
                    unsigned threads);

/// By how much the time falls, from the published times; empty where there are none.
std::string published_fall(std::string_view scene, std::string_view method, unsigned threads);

/// Single numbers that the text quotes.
void quote_build_goals(const BuildMeasurements& measured, Numbers& numbers);

}  // namespace space::ch08
