/// @file
/// Pictures by adaptive sampling, beside the full ones; and what is made of the counts and times.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive_data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"

#include <cstdint>
#include <vector>

namespace space::ch06 {

/// Each scene by each rule and threshold; the first of them with other first cells, too.
std::vector<AdaptivePoint> measure_adaptive(const Options& options);

/// Traced pixels that are not the full picture's, over all pictures.
std::uint64_t wrong_answers(const std::vector<AdaptivePoint>& points);

Chart adaptive_chart(const std::vector<AdaptivePoint>& points);  ///< time against wrong pixels
void print_adaptive(const std::vector<AdaptivePoint>& points, bool times);
/// What adaptive_sampling.dox quotes.
void quote_adaptive(const std::vector<AdaptivePoint>& points, bool times, Numbers& numbers);

}  // namespace space::ch06
