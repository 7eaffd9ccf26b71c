/// @file
/// Exercise 1.3, a near miss: compares with the direction in which the camera looks, which is right
/// in the middle of the picture and wrong towards its border.
#pragma once

#include "common/camera.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace space {

inline std::vector<std::uint32_t> front_faces(std::span<const Triangle> triangles,
                                              const Camera& camera) {
    const Double3 backwards = Double3(camera.eye) - Double3(camera.target);
    std::vector<std::uint32_t> front;
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        if (glm::dot(normal(triangles[i]), backwards) > 0.0) front.push_back(i);
    return front;
}

}  // namespace space
