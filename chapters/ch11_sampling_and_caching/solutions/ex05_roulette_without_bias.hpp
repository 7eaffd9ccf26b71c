/// @file
/// Exercise 11.5, our answer. `u < q` and not `u <= q`: at q = 0 nobody goes on, and nothing is
/// divided by 0.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>

namespace space {

/// The throughput with which the path goes on after `bounce` (0, 1, 2, ...); black where it ends.
inline Double3 after_roulette(const Double3& throughput, int bounce, double u) {
    if (bounce < 3) return throughput;
    const double q = std::min(0.95, std::max({throughput.x, throughput.y, throughput.z}));
    return u < q ? throughput / q : Double3(0.0);
}

}  // namespace space
