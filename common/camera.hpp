/// @file
/// A pinhole camera: where rays start, and where a rasteriser projects to.
#pragma once

#include "common/geometry.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace space {

/// Looks from the eye to the target; `up` points upwards in the picture; the field of view is
/// vertical, in degrees.
struct Camera {
    Point3 eye{0.0f, 0.0f, 1.0f};
    Point3 target{0.0f};
    Vector3 up{0.0f, 1.0f, 0.0f};
    float field_of_view = 45.0f;
};

/// The camera's orthonormal axes in world coordinates, in double: x to the right, y up, z *against*
/// the view direction (a right-handed system).
struct CameraFrame {
    Double3 right, up, back;
    double tan_half_fov;

    explicit CameraFrame(const Camera& camera)
        : back(glm::normalize(Double3(camera.eye) - Double3(camera.target))),
          tan_half_fov(std::tan(camera.field_of_view * 0.5 * std::numbers::pi / 180.0)) {
        right = glm::normalize(glm::cross(Double3(camera.up), back));
        up = glm::cross(back, right);
    }
};

/// The ray through the point (x, y) of an image of width x height pixels; (0, 0) is the top left
/// corner of the picture and (0.5, 0.5) the centre of its first pixel. The direction ends on the
/// plane at distance 1 from the eye.
inline Ray camera_ray(const Camera& camera, const CameraFrame& frame, double x, double y, int width,
                      int height) {
    const double half_height = frame.tan_half_fov;
    const double half_width = half_height * width / height;
    const Double3 direction = frame.right * ((2.0 * x / width - 1.0) * half_width) +
                              frame.up * ((1.0 - 2.0 * y / height) * half_height) - frame.back;
    return {.origin = camera.eye, .direction = Vector3(direction)};
}

/// A camera and the size of its picture in pixels: where the picture's rays are.
struct PixelGrid {
    Camera camera;
    CameraFrame frame;
    int width, height;

    PixelGrid(const Camera& of, int w, int h) : camera(of), frame(of), width(w), height(h) {}

    /// Through the centre of the pixel in column x and row y; (0, 0) is the top left one.
    Ray ray(int x, int y) const { return ray_through(x + 0.5, y + 0.5); }
    /// Through any point of the picture, in pixels from its top left corner.
    Ray ray_through(double x, double y) const {
        return camera_ray(camera, frame, x, y, width, height);
    }
    /// Calls visit(x, y) for each pixel, row by row from the top left.
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) visit(x, y);
    }
};

/// One ray through the centre of each pixel, row by row from the top left.
inline std::vector<Ray> camera_rays(const PixelGrid& grid) {
    std::vector<Ray> rays;
    rays.reserve(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
    grid.for_each([&](int x, int y) { rays.push_back(grid.ray(x, y)); });
    return rays;
}

}  // namespace space
