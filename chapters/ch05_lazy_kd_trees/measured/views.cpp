#include "chapters/ch05_lazy_kd_trees/measured/views.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/measurements.hpp"
#include "common/program/error.hpp"
#include "common/random.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace space::ch05 {
namespace {

/// What the middle of the picture shows.
Point3 middle_of(const Scene& scene) {
    const auto naive = Naive<FilteredExact>::build(scene.mesh.triangles());
    const Vector3 way = scene.camera.target - scene.camera.eye;
    const auto hit = closest_hit(naive, {.origin = scene.camera.eye, .direction = way});
    return hit ? scene.camera.eye + hit->t * way : scene.camera.target;
}

// --- plants ---

/// A leaf: a strip that bends downwards, `steps` pieces long, wide in its middle.
TriangleMesh leaf(const Double3& root, double angle, double length, double width, double bend) {
    constexpr int steps = 8;
    const Double3 out{std::cos(angle), 0.0, std::sin(angle)}, side{-out.z, 0.0, out.x};
    TriangleMesh mesh;
    for (int i = 0; i <= steps; ++i) {
        const double s = double(i) / steps;
        const Double3 spine =
            root + length * (s * out + (0.8 * s - bend * s * s) * Double3{0, 1, 0});
        const double half = width * std::sqrt(s) * (1.0 - s) + 0.002;
        for (const double to : {-1.0, 0.0, 1.0})
            mesh.vertices.push_back(
                Point3(spine + to * half * side - std::abs(to) * 0.3 * half * Double3{0, 1, 0}));
    }
    for (std::uint32_t i = 0; i < steps; ++i)
        for (std::uint32_t column = 0; column < 2; ++column) {
            const std::uint32_t a = 3 * i + column, b = a + 3;
            mesh.faces.push_back({a, a + 1, b});
            mesh.faces.push_back({a + 1, b + 1, b});
        }
    return mesh;
}

/// A stem with leaves around it, about 1 high.
TriangleMesh plant(const Double3& at, Pcg32& random) {
    const auto from_to = [&](double low, double high) {
        return low + (high - low) * random.uniform_double();
    };
    const double height = from_to(0.5, 1.0);
    TriangleMesh mesh = moved(tube({{0, 0, 0}, 0.02}, {{0, height, 0}, 0.006}, 6), at);
    double angle = from_to(0.0, 2.0 * std::numbers::pi);
    for (int i = 0; i < 36; ++i) {
        const double up = (i + 0.5) / 36.0;
        const double length = from_to(0.9, 1.1) * (0.2 + 0.35 * (1.0 - up));
        const double bend = from_to(0.7, 1.3);
        mesh.append(leaf(at + Double3{0.0, up * height, 0.0}, angle, length, 0.12, bend));
        angle += 2.39996;  // the golden angle, in which leaves shade each other least
    }
    return mesh;
}

}  // namespace

ViewedScene on_floor(std::string name, const TriangleMesh& mesh) {
    Scene scene;
    scene.name = std::move(name);
    scene.mesh = mesh;
    frame_mesh(scene);
    scene.colors.assign(mesh.faces.size(), srgb(0xC9A66B));
    const Aabb box = bounds(mesh);
    const Double3 low(box.min), centre(box.centroid());
    const double size = glm::length(Double3(box.extent()));
    const double half = 8.0 * size;
    const Double3 corner{centre.x - half, low.y, centre.z - half};
    add(scene, parallelogram(corner, {0, 0, 2 * half}, {2 * half, 0, 0}), srgb(0xB9B2A3));
    add(scene, parallelogram(corner, {2 * half, 0, 0}, {0, half, 0}), srgb(0x8FA7B5));
    add(scene, parallelogram(corner + Double3{0, 0, 2 * half}, {0, half, 0}, {2 * half, 0, 0}),
        srgb(0xA8B58F));

    ViewedScene viewed{.scene = scene, .views = {}};
    Camera camera = scene.camera;
    viewed.views.push_back({"visible", camera});
    const Vector3 way = camera.target - camera.eye;
    camera.target = camera.eye - Vector3{way.x, 0.1f * std::abs(way.y), way.z};
    viewed.views.push_back({"out of view", camera});
    camera = scene.camera;
    camera.target = middle_of(scene);
    camera.eye = camera.target + 0.08f * (camera.eye - camera.target);
    viewed.views.push_back({"close-up", camera});
    return viewed;
}

ViewedScene plants(std::uint32_t along, std::uint64_t seed) {
    Scene scene;
    scene.name = "plants";
    const double size = 0.6 * along;
    Pcg32 random(seed);
    const Color greens[]{srgb(0x4F7942), srgb(0x6B8E23), srgb(0x3E7C59), srgb(0x88A050)};
    for (std::uint32_t i = 0; i < along; ++i)
        for (std::uint32_t j = 0; j < along; ++j) {
            const double x = 0.6 * (i + 0.2 + 0.6 * random.uniform_double());
            const double z = 0.6 * (j + 0.2 + 0.6 * random.uniform_double());
            const Color& green = greens[random.below(4)];
            add(scene, plant({x, 0.0, z}, random), green);
        }
    const double tile = (size + 4.0) / along;
    for (std::uint32_t i = 0; i < along; ++i)
        for (std::uint32_t j = 0; j < along; ++j)
            add(scene,
                parallelogram({tile * i - 2.0, 0, tile * j - 2.0}, {0, 0, tile}, {tile, 0, 0}),
                srgb(0x8A7A5C));
    scene.background = srgb(0xCFE0EA);
    add_light(scene, {-30, 60, size + 30}, {size / 2, 0, size / 2}, Color{0.95f, 0.88f, 0.75f});
    add_light(scene, {size + 20, 25, size + 20}, {size / 2, 0, size / 2},
              Color{0.25f, 0.28f, 0.32f});
    add_light(scene, {size / 2, 50, size / 2}, {size / 2, 0, size / 2}, Color{0.2f, 0.22f, 0.25f});
    const auto middle = float(size / 2), end = float(size);
    scene.camera = {.eye = {middle, 1.5f, end + 1.8f},
                    .target = {middle, 0.3f, 0.55f * end},
                    .field_of_view = 50};
    const Camera above{
        .eye = {0.9f, 2.6f, end - 0.1f}, .target = {0.9f, 0.3f, end - 0.9f}, .field_of_view = 32};
    return {.scene = scene, .views = {{"view 1", scene.camera}, {"view 2", above}}};
}

std::vector<ViewedScene> viewed_scenes(const Options& options) {
    const Limits limit = limits(options);
    std::vector<ViewedScene> scenes;
    scenes.push_back(on_floor("teapot", teapot(limit.teapot)));
    if (options.amount() == Amount::full && !options.quick) {
        try {
            scenes.push_back(on_floor("dragon_871k", make_scene("dragon_871k").mesh));
        } catch (const Error&) {  // a file that this machine does not have
        }
    }
    scenes.push_back(plants(limit.plants, options.seed));
    return scenes;
}

}  // namespace space::ch05
