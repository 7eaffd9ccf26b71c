#include "ex05_pixel_to_ray.hpp"

#include "chapters/ch01_naive_ray_tracing/coordinate_systems.hpp"
#include "tests/catch.hpp"

using namespace space;

namespace {

/// Its image plane reaches from -1 to 1 upwards.
const Camera straight{.eye = {0, 0, 0}, .target = {0, 0, -1}, .field_of_view = 90.0f};

}  // namespace

TEST_CASE("a picture of one pixel looks straight ahead") {
    const Ray ray = ray_of_pixel(straight, 0, 0, 1, 1);
    CHECK(ray.origin == straight.eye);
    CHECK(glm::distance(ray.direction, Vector3(0, 0, -1)) < 1e-6f);
}

TEST_CASE("in a picture of 2 x 2 pixels the rays go through the middles of the quarters") {
    CHECK(glm::distance(ray_of_pixel(straight, 0, 0, 2, 2).direction, Vector3(-0.5f, 0.5f, -1)) <
          1e-6f);
    CHECK(glm::distance(ray_of_pixel(straight, 1, 0, 2, 2).direction, Vector3(0.5f, 0.5f, -1)) <
          1e-6f);
    CHECK(glm::distance(ray_of_pixel(straight, 1, 1, 2, 2).direction, Vector3(0.5f, -0.5f, -1)) <
          1e-6f);
}

TEST_CASE(
    "the field of view is vertical: a picture twice as wide as high sees twice as far to the "
    "sides") {
    CHECK(glm::distance(ray_of_pixel(straight, 0, 0, 4, 2).direction, Vector3(-1.5f, 0.5f, -1)) <
          1e-6f);
}

TEST_CASE("the points along each ray are seen in the centre of its pixel") {
    const Camera camera{
        .eye = {3, -2, 5}, .target = {0, 1, -1}, .up = {0.1f, 1, 0}, .field_of_view = 35.0f};
    const CameraFrame frame(camera);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 20; ++x) {
            const Ray ray = ray_of_pixel(camera, x, y, 20, 12);
            const Double3 point = Double3(ray.origin) + 7.0 * Double3(ray.direction);
            const Double3 seen = world_to_camera(camera, frame, point);
            CHECK(std::abs(depth(seen) - 7.0) < 1e-5);
            CHECK(glm::distance(camera_to_pixel(frame, seen, 20, 12),
                                glm::dvec2(x + 0.5, y + 0.5)) < 1e-4);
        }
}
