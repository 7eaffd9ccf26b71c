/// @file
/// Exercise 7.3, our answer.
#pragma once

#include <algorithm>
#include <cstddef>

namespace space {

/// low <= centroid <= high, all of them finite; 1 <= bins <= 1024.
inline std::size_t bin_of(float centroid, float low, float high, std::size_t bins) {
    if (!(low < high)) return 0;
    const double place = double(bins) * (double{centroid} - low) / (double{high} - low);
    return std::min(static_cast<std::size_t>(place), bins - 1);
}

}  // namespace space
