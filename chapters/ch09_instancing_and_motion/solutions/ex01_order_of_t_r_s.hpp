/// @file
/// Exercise 9.1, our answer.
#pragma once

#include "common/geometry.hpp"

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace space {

struct Placed {
    Double3 translation{0.0};
    glm::dmat3 rotation{1.0};
    Double3 scale{1.0};
};

inline Double3 point_to_world(const Placed& placed, const Double3& p) {
    return placed.rotation * (placed.scale * p) + placed.translation;
}

inline Double3 direction_to_local(const Placed& placed, const Double3& d) {
    return glm::transpose(placed.rotation) * d / placed.scale;
}

inline Double3 point_to_local(const Placed& placed, const Double3& q) {
    return direction_to_local(placed, q - placed.translation);
}

}  // namespace space
