#include "ex04_tests_per_pixel.hpp"

#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <numeric>

using namespace space;

namespace {

/// Random triangles of about a tenth of the picture, and two lights.
Scene random_scene(std::uint32_t triangles) {
    Scene scene;
    Pcg32 random(7);
    const auto point = [&] { return random_vector(random); };
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const Point3 centre = point();
        scene.mesh.vertices.insert(
            scene.mesh.vertices.end(),
            {centre + 0.3f * point(), centre + 0.3f * point(), centre + 0.3f * point()});
        scene.mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    scene.camera = {.eye = {0, 0, 4}, .target = {0, 0, 0}, .field_of_view = 40.0f};
    scene.lights = {{.position = {3, 4, 5}}, {.position = {-4, 1, -3}}};
    return scene;
}

}  // namespace

TEST_CASE("a pixel that sees nothing costs one test for each triangle") {
    Scene scene = random_scene(20);
    scene.camera.target = {0, 0, 8};
    CHECK(tests_per_pixel(scene, 3, 2) == std::vector<std::uint64_t>(6, 20));
}

TEST_CASE("a pixel that sees a lit surface costs as much again for each light in front of it") {
    Scene scene;
    scene.mesh = {{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, {{0, 1, 2}}};
    scene.camera = {.eye = {0, 0, 5}, .target = {0, 0, 0}, .field_of_view = 20.0f};
    scene.lights = {{.position = {0, 0, 5}},
                    {.position = {1, 1, 5}},
                    {.position = {0, 0, -5}}};  // one is behind
    CHECK(tests_per_pixel(scene, 2, 2) == std::vector<std::uint64_t>(4, 3));
}

TEST_CASE("a shadow ray costs no more than the tests up to the first hit") {
    Scene scene;
    scene.mesh = {{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}, {-90, -90, 0}, {90, -90, 0}, {0, 90, 0}},
                  {{0, 1, 2}, {3, 4, 5}}};
    scene.camera = {.eye = {4, 0, 4},
                    .target = {0, 0, 0},
                    .field_of_view = 1.0f};  // the floor, below the small triangle
    scene.lights = {{.position = {0, 0, 4}}};
    CHECK(tests_per_pixel(scene, 1, 1) == std::vector<std::uint64_t>{2 + 1});
}

TEST_CASE("a shadow ray ends at its light: the ceiling above a lamp costs a test and ends none") {
    Scene scene;
    scene.mesh = {
        {{-90, -90, 6}, {90, -90, 6}, {0, 90, 6}, {-90, -90, 0}, {90, -90, 0}, {0, 90, 0}},
        {{0, 1, 2}, {3, 4, 5}}};
    scene.camera = {.eye = {4, 0, 4}, .target = {0, 0, 0}, .field_of_view = 1.0f};
    scene.lights = {{.position = {0, 0, 4}}};
    CHECK(tests_per_pixel(scene, 1, 1) == std::vector<std::uint64_t>{2 + 2});
}

TEST_CASE("the top left pixel comes first, and its row before the next") {
    Scene scene;  // a triangle that only the picture's top right quarter sees, lit from the front
    scene.mesh = {{{1, 1, 0}, {90, 1, 0}, {1, 90, 0}}, {{0, 1, 2}}};
    scene.camera = {.eye = {0, 0, 5}, .target = {0, 0, 0}, .field_of_view = 90.0f};
    scene.lights = {{.position = {0, 0, 5}}};
    CHECK(tests_per_pixel(scene, 2, 2) == std::vector<std::uint64_t>{1, 2, 1, 1});
}

TEST_CASE("the pixels' tests add up to the renderer's") {
    const Scene scene = random_scene(60);
    const std::vector<std::uint64_t> tests = tests_per_pixel(scene, 40, 30);
    REQUIRE(tests.size() == 40 * 30);
    const Rendering rendering =
        render(scene, Naive<>::build(scene.mesh.triangles()), {.width = 40, .height = 30});
    CHECK(std::accumulate(tests.begin(), tests.end(), std::uint64_t{0}) ==
          rendering.counts.traversal.triangles_tested);
}
