/// @file
/// Patterns of samples, ways to look for light, and estimators beside exact values: claim O1.
#pragma once

#include "chapters/ch11_sampling_and_caching/measured/sampling_data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <cstdint>
#include <vector>

namespace space::ch11 {

SamplingMeasurements measure_sampling(const Options& options);

/// The parts, of which charts show some.
std::vector<PatternPoint> measure_patterns(const Options& options);
std::vector<SphericalTrianglePoint> measure_spherical_triangles(const Options& options);
std::vector<LightingPoint> measure_lightings(const Options& options);
std::vector<PathWorkPoint> measure_path_work(const Options& options);
std::vector<ReferencePoint> measure_references(const Options& options);

void print_sampling(const SamplingMeasurements& measured, bool times);
void quote_sampling(const SamplingMeasurements& measured, bool times, Numbers& numbers);
/// Estimators whose mean is not the exact value; and in a run with times, whose samples are enough,
/// ways of lighting whose means differ.
std::uint64_t wrong_sampling(const SamplingMeasurements& measured, bool times);
/// O1.
std::vector<ClaimAnswer> answer_sampling(const SamplingMeasurements& measured);

Chart patterns_chart(const std::vector<PatternPoint>& patterns);
/// Efficiency, uniform directions = 1, by scene and way of lighting.
Chart lightings_chart(const std::vector<LightingPoint>& lightings);

}  // namespace space::ch11
