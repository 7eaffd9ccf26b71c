#include "common/camera.hpp"

#include "tests/catch.hpp"

#include <numbers>
#include <vector>

namespace space {
namespace {

/// Looks along -z; the image plane at distance 1 reaches from -1 to 1 upwards.
const Camera square{.eye = {1, 2, 5}, .target = {1, 2, 0}, .field_of_view = 90.0f};

Ray ray_at(const Camera& camera, double x, double y, int width, int height) {
    return camera_ray(camera, CameraFrame(camera), x, y, width, height);
}

}  // namespace

TEST_CASE("rays through the corners and the centre of a picture twice as wide as high") {
    CHECK(ray_at(square, 100, 50, 200, 100).direction == Vector3(0, 0, -1));
    CHECK(ray_at(square, 0, 0, 200, 100).direction == Vector3(-2, 1, -1));
    CHECK(ray_at(square, 200, 0, 200, 100).direction == Vector3(2, 1, -1));
    CHECK(ray_at(square, 0, 100, 200, 100).direction == Vector3(-2, -1, -1));
    CHECK(ray_at(square, 200, 100, 200, 100).direction == Vector3(2, -1, -1));
    CHECK(ray_at(square, 0.5, 0.5, 2, 2).direction ==
          Vector3(-0.5f, 0.5f, -1));  // the first pixel's centre
}

TEST_CASE("rays start at the eye, reach from 0 to infinity and are valid") {
    const Ray ray = ray_at(square, 3, 4, 10, 10);
    CHECK(ray.origin == square.eye);
    CHECK(ray.tmin == 0.0f);
    CHECK(ray.tmax == infinity);
    CHECK(is_valid(ray));
}

TEST_CASE("the camera's axes are orthonormal and right-handed, however it looks") {
    for (const Camera& camera : {square, Camera{{3, -4, 1}, {0.5f, 2, 7}, {0, 0, 1}, 30},
                                 Camera{{0, 10, 0}, {0, 0, 0}, {1, 0, 0}, 60}}) {
        const CameraFrame frame(camera);
        CHECK(glm::length(frame.right) == Approx(1).epsilon(1e-14));
        CHECK(glm::length(frame.up) == Approx(1).epsilon(1e-14));
        CHECK(glm::dot(frame.right, frame.up) == Approx(0).margin(1e-14));
        CHECK(glm::dot(frame.right, frame.back) == Approx(0).margin(1e-14));
        CHECK(glm::length(glm::cross(frame.right, frame.up) - frame.back) < 1e-14);
        CHECK(glm::dot(frame.up, Double3(camera.up)) > 0);
    }
}

TEST_CASE("the field of view is the vertical angle between the rays of the upper and lower edge") {
    Camera camera = square;
    camera.field_of_view = 40;
    const Double3 top(ray_at(camera, 5, 0, 10, 8).direction),
        bottom(ray_at(camera, 5, 8, 10, 8).direction);
    const double angle = std::acos(glm::dot(top, bottom) / glm::length(top) / glm::length(bottom));
    CHECK(angle * 180.0 / std::numbers::pi == Approx(40).epsilon(1e-6));
}

TEST_CASE("the same camera gives the same ray, bit for bit, from any frame made of it") {
    const Camera camera{{3, -4, 1}, {0.5f, 2, 7}, {0, 0, 1}, 30};
    const CameraFrame frame(camera);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 9; ++x)
            CHECK(camera_ray(camera, frame, x + 0.5, y + 0.5, 9, 7).direction ==
                  ray_at(camera, x + 0.5, y + 0.5, 9, 7).direction);
}

TEST_CASE("a grid's rays go through its pixels' centres, row by row from the top left") {
    const Camera camera{{3, -4, 1}, {0.5f, 2, 7}, {0, 0, 1}, 30};
    const PixelGrid grid(camera, 3, 2);
    std::vector<Ray> expected;
    for (const double y : {0.5, 1.5})
        for (const double x : {0.5, 1.5, 2.5}) expected.push_back(ray_at(camera, x, y, 3, 2));
    const std::vector<Ray> rays = camera_rays(grid);
    REQUIRE(rays.size() == expected.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CHECK(rays[i].origin == expected[i].origin);
        CHECK(rays[i].direction == expected[i].direction);
    }
    CHECK(grid.ray(2, 1).direction == rays.back().direction);
    CHECK(grid.ray_through(0.0, 2.0).direction == ray_at(camera, 0.0, 2.0, 3, 2).direction);
}

}  // namespace space
