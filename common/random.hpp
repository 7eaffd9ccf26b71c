/// @file
/// Random points and directions. Each component is drawn in an expression of its own: in which
/// order a compiler evaluates the arguments of one call is its own choice.
#pragma once

#include "common/geometry.hpp"
#include "common/pcg32.hpp"

#include <cmath>

namespace space {

/// Evenly in the box: x is drawn first.
template <int D>
Point<D> random_point(Pcg32& random, const BasicAabb<D>& box) {
    Point<D> p;
    for (int axis = 0; axis < D; ++axis) p[axis] = random.uniform(box.min[axis], box.max[axis]);
    return p;
}

/// Evenly in the cube whose coordinates lie from `low` to `high`.
inline Point3 random_point(Pcg32& random, float low, float high) {
    return random_point(random, Aabb{Point3(low), Point3(high)});
}

/// Each component evenly from -1 to 1.
inline Vector3 random_vector(Pcg32& random) {
    return random_point(random, -1.0f, 1.0f);
}

/// Of length 1, every direction as likely as any other: points of the ball, without those near its
/// centre, whose directions are coarse.
inline Double3 random_direction(Pcg32& random) {
    for (;;) {
        const Double3 v{random_vector(random)};
        const double square = glm::dot(v, v);
        if (square > 0.01 && square <= 1.0) return v / std::sqrt(square);
    }
}

}  // namespace space
