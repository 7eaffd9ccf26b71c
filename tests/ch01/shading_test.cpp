#include "chapters/ch01_naive_ray_tracing/shading.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <numbers>
#include <utility>

using namespace space;

namespace {

constexpr Triangle unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};  // front side: +z
constexpr auto always_seen = [](const Ray&) { return true; };

/// A floor at z = 0 under a light at height 2, seen from above; more triangles may stand between.
Scene lit_floor(std::initializer_list<Triangle> occluders = {}) {
    Scene scene;
    const auto add = [&](const Triangle& t) {
        const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
        scene.mesh.vertices.insert(scene.mesh.vertices.end(), {t.a, t.b, t.c});
        scene.mesh.faces.push_back({first, first + 1, first + 2});
    };
    add({{-10, -10, 0}, {10, -10, 0}, {0, 10, 0}});
    for (const Triangle& occluder : occluders) add(occluder);
    scene.lights = {{.position = {0, 0, 2}, .intensity = Color(8.0f)}};
    scene.background = {0.25f, 0.5f, 0.75f};
    return scene;
}

Triangle horizontal(float z, float size = 1.0f) {
    return {{-size, -size, z}, {size, -size, z}, {0, size, z}};
}

/// The colour that a ray which comes from the side and meets the floor's origin sees.
Color color_at_origin(const Scene& scene) {
    RenderCounts rays;
    NoCounts none;
    return color_of_ray(scene, Naive<>::build(scene.mesh.triangles()),
                        {.origin = {3, 0, 3}, .direction = {-1, 0, -1}}, rays, none);
}

}  // namespace

TEST_CASE("Lambert: cosine over pi and squared distance, from a light of intensity 8") {
    const Double3 n(0, 0, 1);
    CHECK(lambert(Color(1.0f), Color(8.0f), n, {0, 0, 2}).x == Approx(2.0 / std::numbers::pi));
    CHECK(lambert(Color(0.5f), Color(8.0f), n, {0, 0, 2}).x == Approx(1.0 / std::numbers::pi));
    // 60 degrees from the normal, distance 2: half of it.
    CHECK(lambert(Color(1.0f), Color(8.0f), n, {std::sqrt(3.0), 0, 1}).x ==
          Approx(1.0 / std::numbers::pi));
    CHECK(lambert(Color(1.0f), Color(8.0f), n, {1, 0, 0}) == Color(0.0f));   // along the surface
    CHECK(lambert(Color(1.0f), Color(8.0f), n, {0, 0, -2}) == Color(0.0f));  // from behind
}

TEST_CASE("the front side is the one from which the vertices run counter-clockwise") {
    const Ray from_above{.origin = {0.2f, 0.2f, 1}, .direction = {0, 0, -1}};
    const Ray from_below{.origin = {0.2f, 0.2f, -1}, .direction = {0, 0, 1}};
    CHECK(seen_from_front(unit, from_above));
    CHECK_FALSE(seen_from_front(unit, from_below));
    CHECK_FALSE(seen_from_front({unit.a, unit.c, unit.b}, from_above));
    CHECK(normal_towards(unit, from_above) == Double3(0, 0, 1));
    CHECK(normal_towards(unit, from_below) == Double3(0, 0, -1));
}

TEST_CASE("front and back side are lit alike") {
    Scene scene = lit_floor();
    const Color front = color_at_origin(scene);
    std::swap(scene.mesh.faces[0][1], scene.mesh.faces[0][2]);
    CHECK(front.x > 0.0f);
    CHECK(color_at_origin(scene) == front);
}

TEST_CASE("a light behind the surface that is seen does not light it") {
    Scene scene = lit_floor();
    const Ray from_below{.origin = {0, 0, -1}, .direction = {0, 0, 1}};
    CHECK(shade(scene, from_below, Hit{.t = 1, .u = 0.25f, .v = 0.5f}, always_seen) == Color(0.0f));
}

TEST_CASE("the floor under the light has Lambert's colour") {
    const Color expected = Scene::default_color * static_cast<float>(2.0 / std::numbers::pi);
    CHECK(glm::distance(color_at_origin(lit_floor()), expected) < 1e-6f);
}

TEST_CASE("what stands between a point and the light throws a shadow") {
    CHECK(color_at_origin(lit_floor({horizontal(1.0f)})) == Color(0.0f));
    CHECK(color_at_origin(lit_floor({horizontal(1e-4f, 1e-5f)})) == Color(0.0f));  // however close
}

TEST_CASE("an occluder beyond the light throws no shadow") {
    CHECK(color_at_origin(lit_floor({horizontal(2.5f)})) == color_at_origin(lit_floor()));
    CHECK(color_at_origin(lit_floor({horizontal(2.0001f)})) == color_at_origin(lit_floor()));
}

TEST_CASE("what is behind the surface throws no shadow") {
    CHECK(color_at_origin(lit_floor({horizontal(-1e-3f)})) == color_at_origin(lit_floor()));
}

TEST_CASE("shadow origins never meet their own triangle again, and rounded hit points often do") {
    // Triangles of size 1, far from the world's origin and near it, some in a coordinate plane.
    const std::array<float, 4> distances{0.0f, 1.0f, 1e3f, 1e5f};
    for (const float distance : distances) {
        Pcg32 random(17);
        int rays = 0, plain = 0, offset = 0;
        for (int i = 0; i < 20'000; ++i) {
            const Point3 centre = distance * random_vector(random);
            Triangle triangle{centre + random_vector(random), centre + random_vector(random),
                              centre + random_vector(random)};
            if (i % 10 == 0) triangle.a.x = triangle.b.x = triangle.c.x = 0.0f;
            const Point3 eye = centre + 4.0f * random_vector(random);
            const float u = 0.5f * random.uniform(), v = 0.5f * random.uniform();
            const Point3 aim =
                triangle.a + u * (triangle.b - triangle.a) + v * (triangle.c - triangle.a);
            const Ray ray{.origin = eye, .direction = aim - eye};
            const Point3 target = centre + 4.0f * random_vector(random);
            const auto hit = MollerTrumbore::intersect(ray, triangle);
            if (!hit) continue;
            const Double3 n = normal_towards(triangle, ray);
            const Double3 p = hit_point(triangle, *hit);
            const PointLight light{target, Color(1)};
            const Ray shadow = shadow_ray(shadow_origin(triangle, p, n), light);
            if (glm::dot(n, Double3(shadow.direction)) <= 0.0) continue;
            ++rays;
            plain += MollerTrumbore::intersect(shadow_ray(Point3(p), light), triangle).has_value();
            offset += MollerTrumbore::intersect(shadow, triangle).has_value();
        }
        INFO("distance " << distance << ", shadow rays " << rays
                         << ", meet themselves without the offset " << plain);
        CHECK(rays > 5'000);
        CHECK(plain > rays / 10);
        CHECK(offset == 0);
    }
}

TEST_CASE("shadow origins leave triangles of subnormal coordinates, too") {
    Pcg32 random(18);
    int rays = 0;
    for (int i = 0; i < 20'000; ++i) {
        // From 3 to 2^24 of the smallest steps of floats.
        const float size = std::ldexp(3.0f, -149 + i % 24);
        const auto corner = [&] { return size * Point3(random_vector(random)); };
        Triangle triangle;
        triangle.a = corner();
        triangle.b = corner();
        triangle.c = corner();
        if (i % 10 == 0) triangle.a.x = triangle.b.x = triangle.c.x = 0.0f;
        const Double3 n = normal(triangle);
        if (n == Double3(0.0)) continue;
        const float u = 0.5f * random.uniform(), v = 0.5f * random.uniform();
        const Double3 p = hit_point(triangle, {.t = 1.0f, .u = u, .v = v});
        for (const Double3& side : {n, -n}) {
            const Double3 origin{shadow_origin(triangle, p, side)};
            ++rays;
            if (!(glm::dot(glm::normalize(side), origin - Double3(triangle.a)) > 0.0))
                FAIL("size " << size << ", triangle " << i);
        }
    }
    CHECK(rays > 30'000);
}

TEST_CASE("a shadow origin lies within a few float steps of the hit point") {
    const Triangle triangle{{100, 200, 300}, {101, 200, 300}, {100, 201, 301}};
    const Double3 p = hit_point(triangle, {.t = 1, .u = 0.25f, .v = 0.25f});
    const Double3 moved{shadow_origin(triangle, p, normal(triangle))};
    for (int axis = 0; axis < 3; ++axis)
        CHECK(std::abs(moved[axis] - p[axis]) <= 3 * float_roundoff * 301);
}
