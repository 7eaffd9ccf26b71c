#include "chapters/ch01_naive_ray_tracing/coordinate_systems.hpp"
#include "tests/check.hpp"

// The exercise is to do without the book's own: the compiler refuses them from here on.
#pragma GCC poison camera_ray camera_rays PixelGrid ray_through
#include "ex05_pixel_to_ray.hpp"

using namespace space;

namespace {

/// Its image plane reaches from -1 to 1 upwards.
const Camera straight{.eye = {0, 0, 0}, .target = {0, 0, -1}, .field_of_view = 90.0f};

Error off(const Ray& ray, const Vector3& direction) {
    return {glm::distance(ray.direction, direction), 1e-6};
}

}  // namespace

TEST_CASE("a picture of one pixel looks straight ahead") {
    const Ray ray = ray_of_pixel(straight, 0, 0, 1, 1);
    CAPTURE(ray);
    CHECK(ray.origin == straight.eye);
    CHECK(off(ray, {0, 0, -1}));
}

TEST_CASE("in a picture of 2 x 2 pixels the rays go through the middles of the quarters") {
    for (const int x : {0, 1})
        for (const int y : {0, 1}) {
            const Ray ray = ray_of_pixel(straight, x, y, 2, 2);
            const Vector3 wanted{x == 0 ? -0.5f : 0.5f, y == 0 ? 0.5f : -0.5f, -1};
            CAPTURE(x, y, ray, wanted);
            REQUIRE(off(ray, wanted));
        }
}

TEST_CASE("the field of view is vertical: in a picture twice as wide as high, too") {
    const Ray ray = ray_of_pixel(straight, 0, 0, 4, 2);
    const Vector3 wanted{-1.5f, 0.5f, -1};
    CAPTURE(ray, wanted);
    CHECK(off(ray, wanted));
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
            const glm::dvec2 pixel = camera_to_pixel(frame, seen, 20, 12);
            CAPTURE(x, y, ray, pixel);
            REQUIRE(Error{std::abs(depth(seen) - 7.0), 1e-5});
            REQUIRE(Error{glm::distance(pixel, glm::dvec2(x + 0.5, y + 0.5)), 1e-4});
        }
}
