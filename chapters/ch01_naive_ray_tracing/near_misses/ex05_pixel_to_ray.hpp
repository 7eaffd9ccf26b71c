/// @file
/// Exercise 1.5, a near miss: lays the centres of the outermost pixels on the picture's border, so
/// that the picture is a little too wide, by one pixel over its whole width.
#pragma once

#include "common/camera.hpp"

namespace space {

inline Ray ray_of_pixel(const Camera& camera, int x, int y, int width, int height) {
    const CameraFrame frame(camera);
    const double half_height = frame.tan_half_fov, half_width = half_height * width / height;
    const Double3 direction = frame.right * ((2.0 * x / (width - 1) - 1.0) * half_width) +
                              frame.up * ((1.0 - 2.0 * y / (height - 1)) * half_height) -
                              frame.back;
    return {.origin = camera.eye, .direction = Vector3(direction)};
}

}  // namespace space
