/// @file
/// Exercise 11.5, a near miss: at most 95 of 100 paths go on, and their throughput is divided by
/// its largest share. Where that is more than 0.95 they do not make good for those that have ended:
/// white rooms lose a twentieth of their light with each bounce, and dark ones nothing.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>

namespace space {

/// The throughput with which the path goes on after `bounce` (0, 1, 2, ...); black where it ends.
inline Double3 after_roulette(const Double3& throughput, int bounce, double u) {
    if (bounce < 3) return throughput;
    const double largest = std::max({throughput.x, throughput.y, throughput.z});
    return u < std::min(0.95, largest) ? throughput / largest : Double3(0.0);
}

}  // namespace space
