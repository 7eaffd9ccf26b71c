/// @file
/// Random rotations and placements: by sums, products and roots alone, whose roundings are the same
/// everywhere. (A sine's are not.)
#pragma once

#include "chapters/ch09_instancing_and_motion/placement.hpp"
#include "common/random.hpp"

#include <glm/mat3x3.hpp>

#include <cmath>

namespace space {

/// Every rotation as likely as any other: a unit quaternion, drawn as a point of the ball in four
/// dimensions.
inline glm::dmat3 random_rotation(Pcg32& random) {
    for (;;) {
        const Double3 v{random_vector(random)};
        const double w{random.uniform(-1.0f, 1.0f)};
        const double square = glm::dot(v, v) + w * w;
        if (square < 0.01 || square > 1.0) continue;
        const double s = 2.0 / square;
        const auto column = [&](int i) {
            Double3 unit(0.0);
            unit[i] = 1.0;
            return unit + s * (w * glm::cross(v, unit) + glm::cross(v, glm::cross(v, unit)));
        };
        return {column(0), column(1), column(2)};
    }
}

/// Turned at random, moved by up to `far` along each axis, and scaled along each axis by a number
/// from 1 to `stretch`.
inline ObjectPlacement random_placement(Pcg32& random, double far, double stretch) {
    ObjectPlacement placement;
    placement.translation = far * Double3(random_vector(random));
    placement.rotation = random_rotation(random);
    for (int axis = 0; axis < 3; ++axis)
        placement.scale[axis] = 1.0 + (stretch - 1.0) * random.uniform_double();
    return placement;
}

/// The same, each number rounded.
inline BasicPlacement<float> rounded(const ObjectPlacement& placement) {
    return {.translation = glm::vec3(placement.translation),
            .rotation = glm::mat3(placement.rotation),
            .scale = glm::vec3(placement.scale)};
}

}  // namespace space
