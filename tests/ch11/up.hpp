/// @file
/// What several of the chapter's tests begin with: a normal, and two random numbers.
#pragma once

#include "common/geometry.hpp"
#include "common/pcg32.hpp"

namespace space {

inline const Double3 up{0, 0, 1};

/// Each in [0, 1); drawn in this order.
inline Double2 random_pair(Pcg32& random) {
    Double2 u;
    u.x = random.uniform_double();
    u.y = random.uniform_double();
    return u;
}

}  // namespace space
