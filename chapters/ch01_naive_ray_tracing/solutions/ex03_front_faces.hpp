/// @file
/// Exercise 1.3, solution.
#pragma once

#include "common/camera.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace space {

inline std::vector<std::uint32_t> front_faces(std::span<const Triangle> triangles,
                                              const Camera& camera) {
    std::vector<std::uint32_t> front;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const Double3 to_eye = Double3(camera.eye) - Double3(triangles[i].a);
        if (glm::dot(normal(triangles[i]), to_eye) > 0.0) front.push_back(i);
    }
    return front;
}

}  // namespace space
