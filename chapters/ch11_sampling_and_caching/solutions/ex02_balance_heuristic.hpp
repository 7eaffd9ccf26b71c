/// @file
/// Exercise 11.2, our answer: in proportion to the number of samples times the density. Quotients,
/// since a sum of densities may be larger than any double.
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
        sum += way.density / ways[chosen].density * way.samples / ways[chosen].samples;
    return 1.0 / sum;
}

}  // namespace space
