// Lit scenes: what they promise about light, mirrors, cameras and walls.
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"

#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/accelerator.hpp"
#include "common/camera.hpp"
#include "common/program/error.hpp"
#include "common/program/temporary.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space {
namespace {

using Tree = Bvh<BinnedBuilder>;

std::vector<std::string_view> names() {
    std::vector<std::string_view> all;
    for (const LitSceneRecipe& recipe : lit_scene_recipes()) all.push_back(recipe.name);
    return all;
}

struct Seen {
    int hits = 0, lights = 0, mirrors = 0, backs = 0;
};

/// What the camera's rays meet.
Seen seen_by_camera(const LitScene& lit) {
    const Tree tree = Tree::build(lit.triangles);
    Seen seen;
    for (const Ray& ray : camera_rays({lit.scene.camera, 40, 30})) {
        const std::optional<Hit> hit = closest_hit(tree, ray);
        if (!hit) continue;
        const bool front =
            glm::dot(normal(lit.triangles[hit->triangle]), Double3(ray.direction)) < 0.0;
        ++seen.hits;
        seen.backs += !front;
        seen.mirrors += lit.is_mirror(hit->triangle);
        seen.lights += lit.emitted(hit->triangle, front) != Double3(0.0);
    }
    return seen;
}

/// How many of random rays from the camera's eye leave the scene.
int leaks(const LitScene& lit, int rays) {
    const Tree tree = Tree::build(lit.triangles);
    Pcg32 random(3);
    int count = 0;
    for (int i = 0; i < rays; ++i)
        count += !closest_hit(
            tree, {.origin = lit.scene.camera.eye, .direction = Vector3(random_direction(random))});
    return count;
}

}  // namespace

TEST_CASE("every lit scene is sound: finite, physical, lit, and its camera sees it") {
    for (const std::string_view name : names())
        for (const bool small : {false, true}) {
            CAPTURE(name, small);
            const LitScene lit = make_lit_scene(name, 1, small);
            const std::size_t count = lit.triangles.size();
            CHECK(lit.scene.name == name);
            CHECK(lit.triangles == lit.scene.mesh.triangles());
            REQUIRE(lit.scene.colors.size() == count);
            REQUIRE(lit.emission.size() == count);
            REQUIRE(lit.mirror.size() == count);
            CHECK(count_degenerate(lit.triangles) == 0);
            CHECK(lit.scene.lights.empty());
            CHECK(lit.sky() == Double3(0.0));
            std::vector<std::uint32_t> lights;
            for (std::uint32_t i = 0; i < count; ++i) {
                for (int channel = 0; channel < 3; ++channel) {
                    const double part = lit.reflectance(i)[channel];
                    if (!(part >= 0.0 && part < 1.0)) FAIL("reflects " << part);
                    const double radiance = lit.emitted(i, true)[channel];
                    if (!(radiance >= 0.0 && std::isfinite(radiance))) FAIL("emits " << radiance);
                }
                if (lit.emitted(i, true) != Double3(0.0)) lights.push_back(i);
                if (lit.emitted(i, false) != Double3(0.0)) FAIL("a back that emits");
            }
            CHECK(lit.lights == lights);
            CHECK_FALSE(lights.empty());
            CHECK(seen_by_camera(lit).hits > 40 * 30 / 4);
            CHECK(make_lit_scene(name, 1, small).triangles == lit.triangles);
        }
}

TEST_CASE("no ray leaves the scenes that are said to be closed, and their camera sees fronts") {
    for (const std::string_view name : {"furnace", "box", "interior", "soup", "sphereflake:1"}) {
        CAPTURE(name);
        const LitScene lit = make_lit_scene(name, 1, true);
        CHECK(leaks(lit, sized(20'000, 2000)) == 0);
        if (name != "soup") CHECK(seen_by_camera(lit).backs == 0);
    }
}

TEST_CASE("a surface of the furnace emits what it does not reflect, to the last bit") {
    const LitScene lit = make_lit_scene("furnace");
    for (std::uint32_t i = 0; i < lit.triangles.size(); ++i)
        CHECK(lit.emitted(i, true) + lit.reflectance(i) == Double3(1.0));
}

TEST_CASE("mirrors are seen where a scene has one, and nowhere else") {
    for (const std::string_view name : names()) {
        CAPTURE(name);
        const int mirrors = seen_by_camera(make_lit_scene(name)).mirrors;
        const bool has_mirrors = name == "mirror" || name == "ring";
        CHECK((mirrors > 40) == has_mirrors);
        CHECK((mirrors > 0) == has_mirrors);
    }
}

TEST_CASE("most light that the interior's camera sees has been reflected at least twice") {
    const LitScene lit = make_lit_scene("interior", 1, true);
    const Tree tree = Tree::build(lit.triangles);
    const LightTable lights(lit);
    Sampler sampler(SamplePattern::independent, 1, 7);
    double once = 0.0, all = 0.0;
    std::uint64_t pixel = 0;
    for (const Ray& ray : camera_rays({lit.scene.camera, sized(80, 20), sized(60, 15)})) {
        sampler.start(pixel++, 0);
        once += luminance(path_radiance(tree, lit, lights, ray, sampler, {.most_bounces = 1}));
        all += luminance(path_radiance(tree, lit, lights, ray, sampler));
    }
    CHECK(once > 0.0);
    CHECK(once < 0.5 * all);
}

TEST_CASE("no path of reflections leads from the light of the wall's scene into the dark room") {
    const LitScene lit = make_lit_scene("wall");
    const Tree tree = Tree::build(lit.triangles);
    Pcg32 random(6);
    int surfaces = 0;
    for (int path = 0; path < sized(3000, 300); ++path) {
        Ray ray{.origin = {-0.75f, 1.25f, 0.0f}, .direction = Vector3(random_direction(random))};
        for (int bounce = 0; bounce < 20; ++bounce) {
            const std::optional<Hit> hit = closest_hit(tree, ray);
            if (!hit) break;
            const Triangle& triangle = lit.triangles[hit->triangle];
            const Double3 n = normal_towards(triangle, ray), p = hit_point(triangle, *hit);
            REQUIRE(p.x < 0.0078126);
            ++surfaces;
            ray = {.origin = shadow_origin(triangle, p, n),
                   .direction = Vector3(random_direction(random))};
            if (glm::dot(n, Double3(ray.direction)) < 0.0) ray.direction = -ray.direction;
        }
    }
    CHECK(surfaces > sized(9000, 900));
}

TEST_CASE("a light panel makes a white surface that faces it as bright as the scene asks") {
    // Far off it is nearly a point: radiance times solid angle over pi is the scene's 0.85.
    const LitScene lit = make_lit_scene("far");
    double brightness = 0.0;
    for (const std::uint32_t light : lit.lights) {
        const Double3 n = normal(lit.triangles[light]), to{lit.triangles[light].a};
        const double distance = glm::length(to);
        brightness += lit.emitted(light, true).x * 0.5 * glm::length(n) *
                      -glm::dot(glm::normalize(n), to / distance) / (distance * distance) /
                      3.14159265358979;
    }
    CHECK(brightness == Approx(0.85).epsilon(0.02));
}

TEST_CASE("a mesh stands in a closed studio, whatever its size and place") {
    const TemporaryDirectory directory;
    const TriangleMesh tetrahedron{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                   .faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    for (const float scale : {1e-6f, 1.0f, 1e6f})
        for (const float place : {0.0f, 1000.0f}) {
            CAPTURE(scale, place);
            TriangleMesh mesh = tetrahedron;
            for (Point3& vertex : mesh.vertices) vertex = scale * (vertex + place);
            write_ply(directory / "mesh.ply", mesh);
            const LitScene lit = make_lit_scene((directory / "mesh.ply").string());
            CHECK(lit.triangles.size() == 4 + 12 + 2);
            CHECK(lit.reflectance(0) == Double3(Scene::default_color));
            CHECK(leaks(lit, 2000) == 0);
            CHECK(seen_by_camera(lit).hits == 40 * 30);
            CHECK(seen_by_camera(lit).backs == 0);
        }
}

TEST_CASE("a studio's light hangs below its ceiling, and its camera may stand anywhere outside") {
    const Camera above{.eye = {1.0f, 40.0f, 2.0f}, .target = {0.0f, 1.0f, 0.0f}},
        below{.eye = {-9.0f, -30.0f, 0.5f}, .target = {0.0f, 1.0f, 0.0f}};
    const std::optional<Camera> cameras[] = {{}, above, below};
    for (const std::string_view name : {"soup", "sphereflake:1", "tree:2", "mount:2", "stadium"})
        for (const std::optional<Camera>& camera : cameras) {
            CAPTURE(name, camera.has_value());
            const LitScene lit = make_lit_scene(name, 1, true, camera);
            Aabb walls, lights;
            for (std::uint32_t i = 0; i < lit.triangles.size(); ++i)
                (lit.emitted(i, true) == Double3(0.0) ? walls : lights)
                    .extend(bounds(lit.triangles[i]));
            CHECK(glm::all(glm::lessThan(lights.max, walls.max)));
            CHECK(glm::all(glm::greaterThan(lights.min, walls.min)));
            CHECK(leaks(lit, 500) == 0);
            if (!camera) continue;
            CHECK(lit.scene.camera.eye == camera->eye);
            CHECK(lit.scene.camera.target == camera->target);
            CHECK(seen_by_camera(lit).hits == 40 * 30);
        }
    CHECK(make_lit_scene("box", 1, true, above).scene.camera.eye == above.eye);
}

TEST_CASE("a studio is refused where floats do not reach from corner to corner, and works below") {
    const TemporaryDirectory directory;
    const std::string file = (directory / "mesh.ply").string();
    int made = 0, refused = 0;
    for (float size = 1e36f; size < 1e38f; size *= 1.1f) {
        CAPTURE(size);
        write_ply(file, {.vertices = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
                         .faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
        try {
            const LitScene lit = make_lit_scene(file);
            ++made;
            CHECK(refused == 0);
            CHECK(diagonal_of(lit) <= std::numeric_limits<float>::max());
            CHECK(leaks(lit, 200) == 0);
        } catch (const Error& error) {
            CHECK(error.code() == ExitCode::bad_input);
            ++refused;
        }
    }
    CHECK(made > 10);
    CHECK(refused > 10);
}

TEST_CASE("a scene that does not exist, and a mesh too large for a studio, are told") {
    const auto told = [](const std::string& spec, ExitCode code) {
        CAPTURE(spec);
        try {
            make_lit_scene(spec);
            FAIL("no error");
        } catch (const Error& error) {
            CHECK(error.code() == code);
        }
    };
    told("nonsense", ExitCode::usage);
    told("ring:3", ExitCode::usage);
    told("room:0", ExitCode::usage);
    told("none.ply", ExitCode::bad_input);
    const TemporaryDirectory directory;
    write_ply(directory / "large.ply",
              {.vertices = {{-3e38f, 0, 0}, {3e38f, 0, 0}, {0, 3e38f, 0}}, .faces = {{0, 1, 2}}});
    told((directory / "large.ply").string(), ExitCode::bad_input);
}

}  // namespace space
