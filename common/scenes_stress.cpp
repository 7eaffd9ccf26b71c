/// @file
/// Scenes that are easy or hard for structures: clouds of random triangles, a sphere of many equal ones.
#include <cmath>

#include "common/pcg32.hpp"
#include "common/scene_makers.hpp"
#include "common/scene_shapes.hpp"

namespace space {
namespace {

const Color& any_color(Pcg32& random) {
    static const Color colors[] = {srgb(0xC8553D), srgb(0xE0A458), srgb(0x3D7C88),
                                   srgb(0x2C4A5E), srgb(0x9AB87A), srgb(0xE7DBC3)};
    return colors[random.below(6)];
}

/// A point of the unit ball in D dimensions, by throwing away those outside.
template <int D>
glm::vec<D, double> in_unit_ball(Pcg32& random) {
    for (;;) {
        glm::vec<D, double> p;
        for (int axis = 0; axis < D; ++axis) p[axis] = 2.0 * random.uniform_double() - 1.0;
        const double length = glm::dot(p, p);
        if (length <= 1.0 && length > 1e-6) return p;  // near 0 a direction would be coarse
    }
}

/// Two perpendicular unit vectors, every orientation as likely as any other: a random quaternion's.
std::pair<Double3, Double3> random_orientation(Pcg32& random) {
    const glm::dvec4 q = glm::normalize(in_unit_ball<4>(random));
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
            {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)}};
}

Double3 in_unit_cube(Pcg32& random) {
    const double x = random.uniform_double(), y = random.uniform_double(), z = random.uniform_double();
    return {x, y, z};
}

void add_triangle(Scene& scene, const Double3& a, const Double3& b, const Double3& c, const Color& color) {
    const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
    for (const Double3& p : {a, b, c}) scene.mesh.vertices.emplace_back(p);
    scene.mesh.faces.push_back({first, first + 1, first + 2});
    scene.colors.push_back(color);
}

/// An equilateral triangle of the given circumradius in any orientation.
void add_random_triangle(Scene& scene, double radius, Pcg32& random) {
    const Double3 center = in_unit_cube(random);
    const auto [u, v] = random_orientation(random);
    const double half = 0.5 * radius, wide = std::sqrt(0.75) * radius;
    add_triangle(scene, center + radius * u, center - half * u + wide * v, center - half * u - wide * v,
                 any_color(random));
}

void look_at_unit_cube(Scene& scene) {
    scene.camera = {.eye = {1.65f, 1.25f, 2.35f}, .target = {0.5f, 0.47f, 0.5f}, .field_of_view = 36};
    scene.background = srgb(0x1E2A33);
    add_light(scene, {1.2, 2.6, 2.2}, {0.5, 0.5, 0.5}, Color{1.1f, 1.02f, 0.9f});
    add_light(scene, {-1.5, 0.6, 1.8}, {0.5, 0.5, 0.5}, Color{0.30f, 0.36f, 0.44f});
    add_light(scene, {2.4, -0.4, 1.0}, {0.5, 0.5, 0.5}, Color{0.22f, 0.20f, 0.20f});
}

}  // namespace

void make_soup(Scene& scene, std::uint32_t triangles, std::uint64_t seed) {
    Pcg32 random(seed);
    const double radius = 0.6 / std::cbrt(triangles);  // a ray meets some 0.2 cbrt(N) of them
    for (std::uint32_t i = 0; i < triangles; ++i) add_random_triangle(scene, radius, random);
    look_at_unit_cube(scene);
}

void make_icosphere(Scene& scene, std::uint32_t frequency, std::uint64_t) {
    add(scene, icosphere(frequency), srgb(0xD98E4A));
    scene.camera = {.eye = {0.0f, 0.9f, 3.2f}, .target = {0, 0, 0}, .field_of_view = 40};
    scene.background = srgb(0x22313B);
    add_light(scene, {-2.5, 3.0, 3.0}, {0, 0, 0}, Color{0.95f, 0.9f, 0.82f});
    add_light(scene, {3.0, 0.5, 2.0}, {0, 0, 0}, Color{0.20f, 0.26f, 0.34f});
    add_light(scene, {0.0, -3.0, 1.5}, {0, 0, 0}, Color{0.10f, 0.08f, 0.08f});
}

}  // namespace space
