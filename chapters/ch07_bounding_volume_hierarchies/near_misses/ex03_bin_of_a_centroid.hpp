/// @file
/// Exercise 7.3, a near miss: the factor bins / extent is computed first, as a builder likes to,
/// once for all centroids. It is rounded, and a centroid on a boundary may fall into the lower bin.
#pragma once

#include <algorithm>
#include <cstddef>

namespace space {

/// low <= centroid <= high, all of them finite; 1 <= bins <= 1024.
inline std::size_t bin_of(float centroid, float low, float high, std::size_t bins) {
    if (!(low < high)) return 0;
    const double scale = double(bins) / (double{high} - low);
    const double place = (double{centroid} - low) * scale;
    return std::min(static_cast<std::size_t>(place), bins - 1);
}

}  // namespace space
