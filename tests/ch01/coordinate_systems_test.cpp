#include "chapters/ch01_naive_ray_tracing/coordinate_systems.hpp"

#include "tests/catch.hpp"

#include <numbers>
#include <utility>

using namespace space;

namespace {

/// Exact to a few roundings of double at coordinates of about 1.
bool close(const Double3& p, const Double3& q) {
    return glm::distance(p, q) < 1e-14;
}

const Camera straight{
    .eye = {0.0f, 0.0f, 5.0f}, .target = {0.0f, 0.0f, 0.0f}, .field_of_view = 90.0f};

}  // namespace

TEST_CASE("local to world scales first, then turns, then moves") {
    const Map map = local_to_world({.translation = {10, 20, 30},
                                    .axis = {0, 0, 1},
                                    .angle = std::numbers::pi / 2,
                                    .scale = {2, 3, 4}});
    // (1, 1, 1) -> scaled (2, 3, 4) -> a quarter turn about z (-3, 2, 4) -> moved (7, 22, 34)
    CHECK(glm::distance(map_point(map, {1, 1, 1}), {7, 22, 34}) < 1e-14);
    CHECK(close(map_vector(map, {1, 1, 1}), {-3, 2, 4}));
}

TEST_CASE("a mirrored mesh keeps its front sides") {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const TriangleMesh mirrored = mapped(local_to_world({.scale = {-1, 1, 1}}), mesh);
    CHECK(mirrored.vertices[1] == Point3(-1, 0, 0));
    CHECK(normal(mesh.triangle(0)) == Double3(0, 0, 1));
    CHECK(normal(mirrored.triangle(0)) == Double3(0, 0, 1));
}

TEST_CASE("the camera looks along its negative z axis, x to the right and y up") {
    const Camera camera{
        .eye = {1, 2, 3}, .target = {-4, 2, 3}, .up = {0, 1, 0}};  // looks along -x: right is -z
    const CameraFrame frame(camera);
    CHECK(close(world_to_camera(camera, frame, {1, 2, 3}), {0, 0, 0}));
    CHECK(close(world_to_camera(camera, frame, {-1, 2, 3}), {0, 0, -2}));
    CHECK(close(world_to_camera(camera, frame, {1, 2, 2}), {1, 0, 0}));
    CHECK(close(world_to_camera(camera, frame, {1, 3, 3}), {0, 1, 0}));
}

TEST_CASE("camera to world undoes world to camera") {
    const Camera camera{
        .eye = {0.3f, -0.7f, 2.1f}, .target = {0.1f, 0.4f, -0.2f}, .up = {0.2f, 1.0f, 0.1f}};
    const CameraFrame frame(camera);
    for (const Double3 p : {Double3(0), Double3(1, 2, 3), Double3(-0.5, 0.25, 0.125)})
        CHECK(close(map_point(camera_to_world(camera), world_to_camera(camera, frame, p)), p));
}

TEST_CASE("with a field of view of 90 degrees the image plane at distance 1 reaches from -1 to 1") {
    const CameraFrame frame(straight);
    const auto pixel = [&](const Double3& p) { return camera_to_pixel(frame, p, 200, 100); };
    const auto at = [](double x, double y) { return glm::dvec2(x, y); };
    CHECK(glm::distance(pixel({0, 0, -1}), at(100, 50)) < 1e-12);
    CHECK(glm::distance(pixel({0, 1, -1}), at(100, 0)) < 1e-12);
    CHECK(glm::distance(pixel({-2, -1, -1}), at(0, 100)) < 1e-12);
    CHECK(glm::distance(pixel({-4, -2, -2}), at(0, 100)) < 1e-12);  // twice as far, twice as large
}

TEST_CASE("the ray of a pixel starts at the eye and ends on the plane at distance 1") {
    const CameraFrame frame(straight);
    const Ray centre = camera_ray(straight, frame, 100.0, 50.0, 200, 100);
    CHECK(centre.origin == straight.eye);
    CHECK(centre.direction == Vector3(0, 0, -1));
    const Ray corner = camera_ray(straight, frame, 0.0, 0.0, 200, 100);
    CHECK(glm::distance(corner.direction, Vector3(-2, 1, -1)) < 1e-6f);
}

TEST_CASE("a pixel's ray passes through the points that are seen in the pixel") {
    const Camera camera{
        .eye = {0.3f, -0.7f, 2.1f}, .target = {0.1f, 0.4f, -0.2f}, .field_of_view = 50.0f};
    const CameraFrame frame(camera);
    for (const auto& [x, y] : {std::pair{0.5, 0.5}, {17.25, 3.0}, {63.5, 47.5}, {40.0, 24.0}}) {
        const Ray ray = camera_ray(camera, frame, x, y, 64, 48);
        const Double3 point = Double3(ray.origin) + 3.0 * Double3(ray.direction);
        const Double3 seen = world_to_camera(camera, frame, point);
        CHECK(depth(seen) == Approx(3.0).epsilon(1e-6));
        // The direction was rounded to float: 2^-24 of some 50 pixels per unit.
        CHECK(glm::distance(camera_to_pixel(frame, seen, 64, 48), glm::dvec2(x, y)) < 1e-5);
    }
}
