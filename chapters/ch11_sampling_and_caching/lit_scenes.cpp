/// @file
/// The lit scenes, each made for what it shows. Metres; y is up.
#include "chapters/ch11_sampling_and_caching/lit_stage.hpp"
#include "common/program/error.hpp"
#include "common/scenes/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace space {
namespace {

const Color white{0.75f}, red{0.63f, 0.18f, 0.11f}, blue{0.12f, 0.30f, 0.42f},
    wood{0.5f, 0.34f, 0.21f};

TriangleMesh floor_of(double half_side) {
    return parallelogram({-half_side, 0, -half_side}, {0, 0, 2 * half_side}, {2 * half_side, 0, 0});
}

/// Looks down: x to the right, z into the depth.
TriangleMesh downwards(const Double3& corner, double width, double depth) {
    return parallelogram(corner, {width, 0, 0}, {0, 0, depth});
}

TriangleMesh turned_box(const Double3& half_size, const Double3& centre, double degrees) {
    return transformed(box(-half_size, half_size), rotation({0, 1, 0}, degrees), centre);
}

// [furnace]
/// Every surface emits what it does not reflect, E = 1 - rho: then L = E + rho L = 1 everywhere.
void make_furnace(LitStage& stage, bool small) {
    const auto add = [&](const TriangleMesh& mesh, const Color& reflectance) {
        stage.add_light(mesh, Color(1.0f) - reflectance);
        std::fill(stage.scene.colors.end() - std::ptrdiff_t(mesh.faces.size()),
                  stage.scene.colors.end(), reflectance);
    };
    add(turned_inside_out(box({-1, 0, -1}, {1, 2, 1})), {0.25f, 0.5f, 0.75f});
    add(ball({0, 0.75, 0}, 0.5, small ? 1 : 3), {0.75f, 0.5f, 0.25f});
    stage.scene.camera = {
        .eye = {0.5f, 1.25f, 0.875f}, .target = {0, 0.75f, 0}, .field_of_view = 60};
}
// [furnace]

void make_box(LitStage& stage, bool) {
    stage.add_closed_room({-1, 0, -1}, {1, 2, 1.5}, white, red, blue, white);
    stage.add_light(downwards({-0.375, 1.96875, -0.375}, 0.75, 0.625), Color{9.0f, 7.8f, 6.0f});
    stage.add(turned_box({0.28, 0.6, 0.28}, {-0.36, 0.6, -0.36}, 17), white);
    stage.add(turned_box({0.28, 0.28, 0.28}, {0.36, 0.28, 0.25}, -19), white);
    stage.scene.camera = {.eye = {0, 1, 1.4375f}, .target = {0, 0.95f, 0}, .field_of_view = 68};
}

/// What the scenes of light sampling share: a floor, and a ball and a box that throw shadows.
void add_stand(LitStage& stage, bool small) {
    stage.add(floor_of(2.0), white);
    stage.add(ball({-0.42, 0.14, 0.02}, 0.14, small ? 2 : 10), red);
    stage.add(turned_box({0.1, 0.2, 0.1}, {0.44, 0.2, -0.08}, 24), blue);
    stage.scene.camera = {.eye = {0, 0.55f, 1.9f}, .target = {0, 0.12f, 0}, .field_of_view = 34};
}

/// The light's distance from a point below it changes by much over the light.
void make_near(LitStage& stage, bool small) {
    add_stand(stage, small);
    stage.add_light(downwards({-0.125, 0.05, -0.125}, 0.25, 0.25), Color{4.0f, 3.7f, 3.2f});
    stage.scene.camera.eye.y = 0.4f;
}

/// Few directions lead to the light.
void make_far(LitStage& stage, bool small) {
    add_stand(stage, small);
    stage.add_panel({-0.6, 3.0, 1.0}, {0, 0, 0}, 0.1, Color{0.85f, 0.8f, 0.7f});
}

/// Most of the light is far off to the side: the cosine knows, its area does not.
void make_large(LitStage& stage, bool small) {
    add_stand(stage, small);
    stage.add_light(downwards({-4, 1, -4}, 8, 8), Color{0.85f, 0.84f, 0.8f});
}

/// The light stands on the floor: one over the square of the distance has no bound.
void make_corner(LitStage& stage, bool small) {
    add_stand(stage, small);
    stage.add_light(parallelogram({-0.75, 0, -0.375}, {1.5, 0, 0}, {0, 0.625, 0}),
                    Color{1.0f, 0.93f, 0.8f});
}

/// The light looks into a mirror: the floor this side of it is lit by way of the mirror alone,
/// which no sampling of the light finds.
void make_mirror(LitStage& stage, bool small) {
    add_stand(stage, small);
    stage.add_mirror(parallelogram({-1.25, 0, -0.75}, {2.5, 0, 0}, {0, 1.25, 0}), Color(0.9f));
    stage.add_light(parallelogram({-0.3, 0.35, 0.3}, {0, 0.4, 0}, {0.6, 0, 0}),
                    Color{5.0f, 4.6f, 4.0f});
    stage.scene.camera = {
        .eye = {1.0f, 0.95f, 2.0f}, .target = {0.05f, 0.22f, 0}, .field_of_view = 36};
}

/// Light that meets the ring's inside gathers on the table below in a curve with a cusp: from afar
/// a nephroid, from a point of the circle a cardioid.
void make_ring(LitStage& stage, bool small) {
    stage.add(floor_of(2.0), {0.66f, 0.58f, 0.5f});
    const glm::dvec2 band[] = {{0.53, 0.0}, {0.53, 0.2}, {0.5, 0.2}, {0.5, 0.0}};
    stage.add_mirror(lathe(band, small ? 64 : 512), Color{0.95f, 0.86f, 0.66f});
    stage.add_panel({1.4, 1.0, -0.7}, {0, 0, 0}, 0.06, Color{0.8f, 0.78f, 0.74f});
    stage.scene.camera = {
        .eye = {0, 1.15f, 1.45f}, .target = {0, 0.04f, 0.02f}, .field_of_view = 42};
}

/// A lamp that hangs below the ceiling shines at it: all else has its light from other surfaces.
void make_interior(LitStage& stage, bool small) {
    const Color plaster{0.8f, 0.76f, 0.68f}, teal{0.30f, 0.45f, 0.48f};
    stage.add_closed_room({-2, 0, -2}, {2, 2.5, 2.5}, plaster, {0.62f, 0.26f, 0.17f}, plaster,
                          wood);
    stage.add(box({-0.75, 1.8, -1.25}, {0.75, 1.86, 0.25}), teal);
    stage.add_light(parallelogram({-0.72, 1.8625, -1.22}, {0, 0, 1.44}, {1.44, 0, 0}),
                    Color{6.5f, 5.6f, 4.3f});
    stage.add(box({-2, 0, -1.5}, {-1.5, 1.25, 1}), teal);
    stage.add(box({-0.25, 0.68, -1.25}, {1.25, 0.72, -0.35}), wood);
    for (const double x : {-0.2, 1.14})
        for (const double z : {-1.2, -0.46})
            stage.add(box({x, 0, z}, {x + 0.06, 0.68, z + 0.06}), wood);
    stage.add(ball({0.2, 0.92, -0.8}, 0.2, small ? 2 : 12), {0.75f, 0.6f, 0.3f});
    stage.add(turned_box({0.12, 0.16, 0.12}, {0.8, 0.88, -0.75}, 30), plaster);
    stage.scene.camera = {
        .eye = {0.9f, 1.45f, 2.375f}, .target = {-0.2f, 0.7f, -0.8f}, .field_of_view = 48};
}

/// Two rooms beside each other, open to the viewer, and a light in the left one. What leaves them
/// never comes back: no light at all comes to the right one.
void make_wall(LitStage& stage, bool) {
    constexpr double front = 0.75, back = -1.0, height = 1.5, depth = front - back, half = 1.5;
    stage.add(parallelogram({-half, 0, back}, {0, 0, depth}, {2 * half, 0, 0}), white);
    stage.add(downwards({-half, height, back}, 2 * half, depth), white);
    stage.add(parallelogram({-half, 0, back}, {2 * half, 0, 0}, {0, height, 0}), white);
    stage.add(parallelogram({-half, 0, back}, {0, height, 0}, {0, 0, depth}), red);
    stage.add(parallelogram({half, 0, back}, {0, 0, depth}, {0, height, 0}), blue);
    stage.add(box({-0.0078125, 0, back}, {0.0078125, height, front}), white);
    stage.add_light(downwards({-1.0, 1.484375, -0.5}, 0.5, 0.5), Color{7.0f, 6.4f, 5.4f});
    stage.scene.camera = {.eye = {0, 1.1f, 3.3f}, .target = {0, 0.7f, 0}, .field_of_view = 36};
}

/// A pane on the wall at `x`, which sees the room to the right of it, and a frame with two bars.
void add_window(LitStage& stage, double x, const Double2& z, const Double2& y,
                const Color& radiance) {
    constexpr double bar = 0.05, half = 0.5 * bar;
    const double middle_z = 0.5 * (z.x + z.y), middle_y = 0.5 * (y.x + y.y);
    stage.add_light(parallelogram({x + 0.01, y.x, z.x}, {0, y.y - y.x, 0}, {0, 0, z.y - z.x}),
                    radiance);
    const auto add_bar = [&](double low_z, double high_z, double low_y, double high_y) {
        stage.add(box({x, low_y, low_z}, {x + 0.04, high_y, high_z}), {0.82f, 0.8f, 0.76f});
    };
    add_bar(z.x - bar, z.x, y.x - bar, y.y + bar);
    add_bar(z.y, z.y + bar, y.x - bar, y.y + bar);
    add_bar(middle_z - half, middle_z + half, y.x, y.y);
    for (const double low : {y.x - bar, middle_y - half, y.y}) add_bar(z.x, z.y, low, low + bar);
}

constexpr LitMaker makers[] = {
    {{"furnace", "a closed box and a ball that emit what they do not reflect: 1 everywhere"},
     make_furnace},
    {{"box", "a closed box with coloured walls, two blocks and a light below the ceiling"},
     make_box},
    {{"near", "a small light close above a floor"}, make_near},
    {{"far", "a small light far above a floor"}, make_far},
    {{"large", "a light much larger than the floor"}, make_large},
    {{"corner", "a light that stands on the floor and meets it"}, make_corner},
    {{"mirror", "a light that looks into a mirror"}, make_mirror},
    {{"ring", "a mirror ring on a table and a small light: a caustic"}, make_ring},
    {{"interior", "a room lit by way of its ceiling"}, make_interior},
    {{"wall", "a thin wall between a lit room and a dark one"}, make_wall},
};

}  // namespace

std::span<const LitMaker> lit_makers() {
    return makers;
}

void make_lit_room(LitStage& stage, std::string_view spec, std::uint64_t seed, bool small) {
    stage.begin_with(make_scene(spec, seed, small));
    // The lamp's bulb, below its shade's inside.
    stage.add_light(downwards({-0.09, 1.9, -0.09}, 0.18, 0.18), Color{140.0f, 98.0f, 54.0f});
    add_window(stage, -2.1, {-1.45, -0.25}, {0.95, 2.15}, Color{5.4f, 6.4f, 7.8f});
    stage.scene.camera = {
        .eye = {0.8f, 1.42f, 2.35f}, .target = {-0.22f, 1.06f, 0.0f}, .field_of_view = 48};
}

void make_lit_studio(LitStage& stage, std::string_view spec, std::uint64_t seed, bool small,
                     const std::optional<Camera>& camera) {
    stage.begin_with(make_scene(spec, seed, small));
    const Camera& own = stage.scene.camera;
    const Aabb box = bounds(stage.scene.mesh);
    const Double3 low(box.min), high(box.max), middle = 0.5 * (low + high);
    double reach = glm::length(high - low), floor = low.y, ceiling = high.y;
    const std::array eyes{Double3(own.eye), Double3(camera ? camera->eye : own.eye)};
    for (const Double3& eye : eyes) reach = std::max(reach, glm::length(eye - middle));
    reach *= 1.25;
    for (const Double3& eye : eyes) {
        floor = std::min(floor, eye.y - 0.1 * reach);
        ceiling = std::max(ceiling, eye.y);
    }
    const Double3 min{middle.x - reach, floor, middle.z - reach},
        max{middle.x + reach, ceiling + 0.5 * reach, middle.z + reach};
    const bool is_in_floats = is_finite<3>(Point3(min)) && is_finite<3>(Point3(max)) &&
                              std::isfinite(static_cast<float>(glm::length(max - min)));
    if (!is_in_floats)
        throw input_error(std::string(spec) + ": too large: the studio around it has no floats");
    stage.add(turned_inside_out(space::box(min, max)), Color{0.62f, 0.60f, 0.57f});
    // Half of its side below the ceiling: it may hang at any angle.
    const Double3 light{middle.x - 0.6 * reach, max.y - 0.15 * reach, middle.z + 0.55 * reach};
    stage.add_panel(light, middle, 0.3 * reach, Color{0.9f, 0.85f, 0.78f});
}

void LitStage::begin_with(Scene dull) {
    scene = std::move(dull);
    scene.lights.clear();
    scene.background = Color(0.0f);
    const std::size_t count = scene.mesh.faces.size();
    scene.colors.resize(count, Scene::default_color);
    for (Color& color : scene.colors) color = glm::min(color, Color(0.9f));
    emission.assign(count, Color(0.0f));
    mirror.assign(count, 0);
}

void LitStage::append(const TriangleMesh& mesh, const Color& reflectance, const Color& radiance,
                      bool is_mirror) {
    space::add(scene, mesh, reflectance);
    emission.resize(scene.mesh.faces.size(), radiance);
    mirror.resize(scene.mesh.faces.size(), is_mirror);
}

void LitStage::add(const TriangleMesh& mesh, const Color& reflectance) {
    append(mesh, reflectance, Color(0.0f), false);
}
void LitStage::add_mirror(const TriangleMesh& mesh, const Color& reflectance) {
    append(mesh, reflectance, Color(0.0f), true);
}
void LitStage::add_light(const TriangleMesh& mesh, const Color& radiance) {
    append(mesh, Color(0.0f), radiance, false);
}

void LitStage::add_panel(const Double3& centre, const Double3& lit, double side,
                         const Color& brightness) {
    const Double3 to_light = centre - lit;
    const CameraFrame frame({.eye = Point3(centre), .target = Point3(lit)});
    // Seen from `lit`: radiance times solid angle is pi times the brightness of white.
    const double radiance = std::numbers::pi * glm::dot(to_light, to_light) / (side * side);
    add_light(parallelogram(centre - 0.5 * side * (frame.right + frame.up), side * frame.up,
                            side * frame.right),
              Color(radiance * Double3(brightness)));
}

void LitStage::add_closed_room(const Double3& min, const Double3& max, const Color& walls,
                               const Color& left, const Color& right, const Color& floor) {
    const Double3 size = max - min, x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    add(parallelogram(min, z, x), floor);
    add(parallelogram(min + y, x, z), walls);
    add(parallelogram(min, x, y), walls);      // back
    add(parallelogram(min + z, y, x), walls);  // front
    add(parallelogram(min, y, z), left);
    add(parallelogram(min + x, z, y), right);
}

}  // namespace space
