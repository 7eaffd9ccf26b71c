#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"

#include <utility>

using namespace space;

namespace {

/// Two walls side by side, 5 in front of the eye, of two triangles each: together they fill the
/// picture. The light is at the eye.
Scene two_walls() {
    Scene scene;
    scene.mesh.vertices = {{-9, -9, 0}, {0, -9, 0}, {0, 9, 0}, {-9, 9, 0}, {9, -9, 0}, {9, 9, 0}};
    scene.mesh.faces = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
    scene.camera = {.eye = {0, 0, 5}, .target = {0, 0, 0}, .field_of_view = 60.0f};
    scene.lights = {{.position = {0, 0, 5}, .intensity = Color(50.0f)}};
    scene.background = {0.0f, 0.0f, 1.0f};
    return scene;
}

/// A small triangle half way between a floor and the light above it, and the floor *last* in the
/// list.
Scene shaded_floor() {
    Scene scene;
    scene.mesh.vertices = {{-1, -1, 1},   {1, -1, 1},   {0, 1, 1},
                           {-10, -10, 0}, {10, -10, 0}, {0, 10, 0}};
    scene.mesh.faces = {{0, 1, 2}, {3, 4, 5}};
    scene.lights = {{.position = {0, 0, 2}, .intensity = Color(8.0f)}};
    return scene;
}

constexpr RenderSettings settings{.width = 40, .height = 30};

}  // namespace

TEST_CASE("corrected: a polygon that is missed later erases nothing") {
    const Scene scene = two_walls();
    const Rendering corrected = render(scene, Naive<>::build(scene.mesh.triangles()), settings);
    CHECK(corrected.counts.hits == 40 * 30);
    CHECK(corrected.counts.shadow_rays == 40 * 30);
    CHECK(corrected.counts.occluded == 0);
}

TEST_CASE("as printed: a later polygon that is missed erases the hit") {
    const Scene scene = two_walls();
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const Rendering printed = algorithm1_as_printed(scene, triangles, settings);
    const CameraFrame frame(scene.camera);
    for (int y = 0; y < settings.height; ++y)
        for (int x = 0; x < settings.width; ++x) {
            const Ray ray =
                camera_ray(scene.camera, frame, x + 0.5, y + 0.5, settings.width, settings.height);
            const bool last_is_hit = MollerTrumbore::intersect(ray, triangles.back()).has_value();
            CHECK((printed.image.at(x, y) != scene.background) == last_is_hit);
        }
    CHECK(printed.counts.hits > 0);
    CHECK(printed.counts.hits < 40 * 30 / 2);
}

TEST_CASE("as printed: a later polygon that is hit farther away erases the hit, too") {
    const Scene near_first = shaded_floor();
    Scene far_first = near_first;
    std::swap(far_first.mesh.faces[0], far_first.mesh.faces[1]);
    const Ray ray{.origin = {0, 0, 2}, .direction = {0, 0, -1}};
    for (const Triangle& triangle : near_first.mesh.triangles())
        REQUIRE(MollerTrumbore::intersect(ray, triangle));
    CHECK_FALSE(color_of_ray_as_printed(near_first, near_first.mesh.triangles(), ray));
    CHECK(color_of_ray_as_printed(far_first, far_first.mesh.triangles(), ray));
}

TEST_CASE("as printed: t may be negative, and what is behind the eye wins") {
    Scene scene = shaded_floor();  // the floor, then the small triangle 1 above it
    std::swap(scene.mesh.faces[0], scene.mesh.faces[1]);
    scene.colors = {Color(0.0f), Color(1.0f)};
    const Ray ray{.origin = {0, 0, 0.5f}, .direction = {0, 0, -1}};  // from between them, downwards
    RenderCounts rays;
    NoCounts none;
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    CHECK(color_of_ray(scene, Naive<>::build(triangles), ray, rays, none) == Color(0.0f));
    const std::optional<Color> printed = color_of_ray_as_printed(scene, triangles, ray);
    REQUIRE(printed);
    CHECK(printed->x > 0.0f);
}

TEST_CASE("as printed: the shadow ray's result is never used") {
    const Scene scene = shaded_floor();
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const Ray ray{.origin = {3, 0, 3},
                  .direction = {-1, 0, -1}};  // to the floor's origin, past the small triangle
    RenderCounts rays;
    NoCounts none;
    CHECK(color_of_ray(scene, Naive<>::build(triangles), ray, rays, none) == Color(0.0f));
    CHECK(rays.occluded == 1);
    const std::optional<Color> printed = color_of_ray_as_printed(scene, triangles, ray);
    REQUIRE(printed);
    CHECK(printed->x > 0.0f);
}

TEST_CASE(
    "every camera ray is tested against every triangle, every shadow ray until the first hit") {
    const Scene scene = two_walls();
    const Rendering rendering = render(scene, Naive<>::build(scene.mesh.triangles()), settings);
    // Nothing occludes: 4 tests for the camera ray and 4 for the shadow ray of each pixel.
    CHECK(rendering.counts.camera_rays == 1200);
    CHECK(rendering.counts.traversal.triangles_tested == 1200 * 4 + 1200 * 4);
    CHECK(render<NoCounts>(scene, Naive<>::build(scene.mesh.triangles()), settings)
              .counts.traversal == TraversalCounts{});
}

TEST_CASE("any number of threads gives the same picture and the same counts") {
    for (const char* name : {"soup:200", "icosphere:4"}) {
        const Scene scene = make_scene(name, 3);
        const Naive<> naive = Naive<>::build(scene.mesh.triangles());
        const Rendering one =
            render(scene, naive, {.width = 33, .height = 25, .samples = 2, .threads = 1});
        for (const unsigned threads : {2u, 3u, 7u}) {
            const Rendering many =
                render(scene, naive, {.width = 33, .height = 25, .samples = 2, .threads = threads});
            CHECK(many.image == one.image);
            CHECK(many.counts == one.counts);
        }
    }
}

TEST_CASE("four samples per pixel are the mean of a picture twice as large") {
    const Scene scene = make_scene("soup:50", 5);
    const Naive<> naive = Naive<>::build(scene.mesh.triangles());
    const Image large = render(scene, naive, {.width = 32, .height = 24}).image;
    const Image small = render(scene, naive, {.width = 16, .height = 12, .samples = 2}).image;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x) {
            const Color mean = (large.at(2 * x, 2 * y) + large.at(2 * x + 1, 2 * y) +
                                large.at(2 * x, 2 * y + 1) + large.at(2 * x + 1, 2 * y + 1)) /
                               4.0f;
            CHECK(small.at(x, y) == mean);
        }
}

TEST_CASE("a convex body throws no shadow on itself") {
    // Every occluded shadow ray here would be shadow acne: the light sees all that faces it.
    Scene scene = make_scene("icosphere:8");
    scene.lights = {{.position = {3, 4, 5}, .intensity = Color(50.0f)}};
    for (const float shift : {0.0f, 10.0f, 100.0f}) {
        Scene moved = scene;
        for (Point3& vertex : moved.mesh.vertices) vertex.x += shift;
        moved.camera.eye.x += shift;
        moved.camera.target.x += shift;
        moved.lights[0].position.x += shift;
        const Rendering rendering =
            render(moved, Naive<>::build(moved.mesh.triangles()), {.width = 60, .height = 60});
        INFO("moved by " << shift);
        CHECK(rendering.counts.shadow_rays > 200);
        CHECK(rendering.counts.occluded == 0);
    }
}

TEST_CASE("an empty scene shows the background") {
    Scene scene;
    scene.background = {0.25f, 0.5f, 1.0f};
    const Rendering rendering = render(scene, Naive<>::build({}), {.width = 3, .height = 2});
    CHECK(rendering.counts.hits == 0);
    CHECK(rendering.image.at(2, 1) == scene.background);
}
