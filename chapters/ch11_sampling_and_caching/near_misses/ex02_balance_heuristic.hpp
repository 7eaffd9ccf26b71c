/// @file
/// Exercise 11.2, a near miss: in proportion to the densities alone. The mean is right with these
/// weights, too; but a way with many samples lies more densely than its density says.
#pragma once

#include <cstddef>
#include <span>

namespace space {

/// A way to choose a point: how densely it would have chosen the one in hand, and how many samples
/// it makes.
struct Way {
    double density = 0.0;
    int samples = 1;
};

/// How much a sample counts that ways[chosen] has made; that density is positive, and it makes at
/// least one sample.
inline double balance_weight(std::span<const Way> ways, std::size_t chosen) {
    double sum = 0.0;  // in units of the chosen way's
    for (const Way& way : ways)
        if (way.samples > 0) sum += way.density / ways[chosen].density;
    return 1.0 / sum;
}

}  // namespace space
