/// @file
/// Exercise 11.1: The cosine's density
/// Difficulty 1 of 3, about 30 minutes.
///
/// Light that comes to a surface counts with the cosine of the angle between its direction and the
/// normal *n*. So more rays should go where the cosine is large: choose directions with a density
/// in proportion to it. One function makes such a direction of two numbers that are uniform in
/// [0, 1); the other tells the density of any direction, per solid angle.
///
/// The check tells neither function how: any way will do that makes a quarter of the directions lie
/// within 30 degrees of the normal, half of them within 45, three quarters within 60, and all alike
/// around it. The normal is any vector of length 1.
#pragma once

#include "common/geometry.hpp"

#include <numbers>

namespace space {

/// A direction of length 1 on the side of `n`; both numbers of `u` are at least 0 and less than 1.
inline Double3 cosine_direction(const Double3& n, const Double2& /*u*/) {
    return n;  // TODO: one of many
}

/// How densely cosine_direction covers this direction, which has length 1, per solid angle; 0 below
/// the surface.
inline double cosine_density(const Double3& /*n*/, const Double3& /*direction*/) {
    return 0.5 / std::numbers::pi;  // TODO: all directions above the surface alike
}

}  // namespace space
