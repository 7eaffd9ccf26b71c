/// @file
/// Error against time of paths, photons and cached irradiance: claims O2 and O3.
#pragma once

#include "chapters/ch11_sampling_and_caching/measured/convergence_data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <string_view>
#include <vector>

namespace space::ch11 {

/// The mirror ring's caustic, the room that is lit by way of its ceiling, and the closed box.
std::vector<Convergence> measure_convergence(const Options& options);

void print_convergence(const std::vector<Convergence>& measured);
void quote_convergence(const std::vector<Convergence>& measured, Numbers& numbers);
/// O2 and O3.
std::vector<ClaimAnswer> answer_convergence(const std::vector<Convergence>& measured);

Chart convergence_chart(const std::vector<Convergence>& measured, std::string_view scene);

}  // namespace space::ch11
