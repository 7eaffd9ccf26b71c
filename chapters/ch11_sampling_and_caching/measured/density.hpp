/// @file
/// What photon maps and the radiance cache count, and where they leak.
#pragma once

#include "chapters/ch11_sampling_and_caching/measured/density_data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"

#include <cstdint>
#include <vector>

namespace space::ch11 {

DensityMeasurements measure_density(const Options& options);

/// The parts.
std::vector<CacheLeakPoint> measure_cache_leaks(const Options& options);
std::vector<CacheCountPoint> measure_cache_counts(const Options& options);

void print_density(const DensityMeasurements& measured);
void quote_density(const DensityMeasurements& measured, Numbers& numbers);
/// Photons that got lost.
std::uint64_t wrong_density(const DensityMeasurements& measured);

}  // namespace space::ch11
