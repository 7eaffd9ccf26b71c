/// @file
/// Exercise 1.5, solution.
#pragma once

#include "common/camera.hpp"

namespace space {

inline Ray ray_of_pixel(const Camera& camera, int x, int y, int width, int height) {
    const CameraFrame frame(camera);
    const double pixel_side = 2.0 * frame.tan_half_fov / height;
    const Double3 direction = frame.right * ((x + 0.5 - 0.5 * width) * pixel_side) +
                              frame.up * ((0.5 * height - y - 0.5) * pixel_side) - frame.back;
    return {.origin = camera.eye, .direction = Vector3(direction)};
}

}  // namespace space
