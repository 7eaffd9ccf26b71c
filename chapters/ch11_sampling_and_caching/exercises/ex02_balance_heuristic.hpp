/// @file
/// Exercise 11.2: The balance heuristic
/// Difficulty 1 of 3, about 20 minutes.
///
/// Several ways choose points for the same integral of *f*: each makes some samples, and a sample
/// *x* of way *i* adds *w f(x) / (n p(x))*, where *n* is the number of way *i*'s samples, *p* its
/// density and *w* the weight that is asked for here. The sum of all of them has the right mean if
/// the weights that a point would get from all ways that can choose it add up to 1.
///
/// Of all such weights take these: wherever *f* is in proportion to how densely all samples
/// together lie, each sample, whichever way made it, adds the same. Densities are 0, or as small as
/// 10^-300, or as large as 10^308: that of a point on a lamp that is hardly larger than a point.
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
inline double balance_weight(std::span<const Way> ways, std::size_t /*chosen*/) {
    return 1.0 / static_cast<double>(ways.size());  // TODO: some ways can choose it, others cannot
}

}  // namespace space
