/// @file
/// Exercise 11.5: Russian roulette without bias
/// Difficulty 1 of 3, about 25 minutes.
///
/// A path's throughput is the share of red, green and blue light that all its surfaces together
/// have reflected. Paths that carry little are not worth their rays, but to cut them off makes the
/// picture darker. So chance decides: a path goes on or ends, and those that go on carry as much
/// more as the others are missing.
///
/// After bounces 0, 1 and 2 all paths go on as they are. From bounce 3 on a path goes on with the
/// probability *q*, the largest of its three shares, but 0.95 at most: between two mirrors it would
/// never end. One that goes on must have a throughput that is right on average, in each colour. `u`
/// is uniform in [0, 1). A path that carries nothing carries nothing afterwards, whatever `u` is.
#pragma once

#include "common/geometry.hpp"

namespace space {

/// The throughput with which the path goes on after `bounce` (0, 1, 2, ...); black where it ends.
inline Double3 after_roulette(const Double3& throughput, int /*bounce*/, double /*u*/) {
    return throughput;  // TODO: right on average, but between two mirrors it never ends
}

}  // namespace space
