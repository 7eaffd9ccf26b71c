/// @file
/// Haines's procedural databases as triangles (Haines 1987, "A Proposed Standard Set of Problems to Test Ray Tracing
/// Algorithms", IEEE CG&A 7:11; the public-domain package's later scenes too). Shapes, sizes and cameras are the
/// published ones; tessellation, colours and lights are ours. z is up.
#include <cmath>

#include "common/scene_makers.hpp"
#include "common/scene_shapes.hpp"

namespace space {
namespace {

/// The rotation that takes +z to the direction, about an axis perpendicular to both.
glm::dmat3 from_z_to(const Double3& direction) {
    const double c = direction.z, s = std::hypot(direction.x, direction.y);
    if (s == 0.0) return c > 0.0 ? glm::dmat3(1.0) : rotation({1, 0, 0}, 180);
    const Double3 a{-direction.y / s, direction.x / s, 0.0};  // z x direction
    return {{c + a.x * a.x * (1 - c), a.x * a.y * (1 - c), -a.y * s},
            {a.x * a.y * (1 - c), c + a.y * a.y * (1 - c), a.x * s},
            {a.y * s, -a.x * s, c}};
}

}  // namespace

/// "balls": a sphere carries nine of a third of its radius, and so on.
void make_sphereflake(Scene& scene, std::uint32_t depth, std::uint64_t) {
    const double a = 1.0 / std::sqrt(2.0);
    const glm::dmat3 tilt = rotation({a, -a, 0}, std::asin(2.0 / std::sqrt(6.0)) * 180.0 / 3.14159265358979323846);
    std::vector<Double3> directions;  // of the nine, where the parent's is +z
    for (int turn = 0; turn < 3; ++turn)
        for (const Double3& d : {Double3{a, a, 0}, Double3{a, 0, -a}, Double3{0, a, -a}})
            directions.push_back(glm::normalize(rotation({0, 0, 1}, 120 * turn) * (tilt * d)));

    add(scene, parallelogram({-12, -12, -0.5}, {24, 0, 0}, {0, 24, 0}), srgb(0xB9B2A3));
    const Color colors[] = {srgb(0xE9C46A), srgb(0xE08E45), srgb(0xC8553D), srgb(0x8C4A5E),
                            srgb(0x4F5D8A), srgb(0x3E8E8C), srgb(0xB5C99A)};
    constexpr std::uint32_t frequencies[] = {8, 4, 2, 2, 2, 2, 2};  // of the spheres of each level
    const auto grow = [&](const auto& self, const Double3& center, double radius, const Double3& direction,
                          std::uint32_t level) -> void {
        add(scene, ball(center, radius, frequencies[level]), colors[level]);
        if (level == depth) return;
        const glm::dmat3 turn = from_z_to(direction);
        for (const Double3& d : directions) {
            const Double3 outwards = turn * d;
            self(self, center + outwards * (radius * (1.0 + 1.0 / 3.0)), radius / 3.0, outwards, level + 1);
        }
    };
    grow(grow, Double3{0.0}, 0.5, {0, 0, 1}, 0);

    scene.camera = {.eye = {2.1f, 1.3f, 1.7f}, .target = {0, 0, 0}, .up = {0, 0, 1}, .field_of_view = 45};
    scene.background = srgb(0xCFE0EA);
    add_light(scene, {4, 3, 2}, {0, 0, 0}, Color{0.75f, 0.70f, 0.62f});
    add_light(scene, {1, -4, 4}, {0, 0, 0}, Color{0.28f, 0.30f, 0.34f});
    add_light(scene, {-3, 1, 5}, {0, 0, 0}, Color{0.28f, 0.28f, 0.28f});
}

}  // namespace space
