/// @file
/// Exercise 1.3: Front faces
/// Difficulty 2 of 3, about 20 minutes.
///
/// A closed body hides its own back sides, and a rasteriser that leaves them out has half the work.
/// Return the indices, in ascending order, of the triangles that turn their front side to the
/// camera's eye. The front is the side that the normal points to (normal() in common/geometry.hpp);
/// a triangle seen edge-on shows neither side and is left out.
#pragma once

#include "common/camera.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace space {

inline std::vector<std::uint32_t> front_faces(std::span<const Triangle> triangles,
                                              const Camera& camera) {
    static_cast<void>(camera);
    std::vector<std::uint32_t> front;
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        front.push_back(i);  // TODO: keep only those seen from the front
    return front;
}

}  // namespace space
