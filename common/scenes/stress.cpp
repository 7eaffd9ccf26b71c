/// @file
/// Scenes that are easy or hard for structures: clouds of random triangles, dust, one triangle as
/// large as all others together, a sphere of many equal ones.
#include "common/pcg32.hpp"
#include "common/scenes/makers.hpp"
#include "common/scenes/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace space {
namespace {

const Color& any_of(std::span<const Color> colors, Pcg32& random) {
    return colors[random.below(static_cast<std::uint32_t>(colors.size()))];
}

const std::array confetti{srgb(0xC8553D), srgb(0xE0A458), srgb(0x3D7C88),
                          srgb(0x2C4A5E), srgb(0x9AB87A), srgb(0xE7DBC3)};

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
    const double x = random.uniform_double(), y = random.uniform_double(),
                 z = random.uniform_double();
    return {x, y, z};
}

void add_triangle(Scene& scene, const Double3& a, const Double3& b, const Double3& c,
                  const Color& color) {
    const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
    for (const Double3& p : {a, b, c}) scene.mesh.vertices.emplace_back(p);
    scene.mesh.faces.push_back({first, first + 1, first + 2});
    scene.colors.push_back(color);
}

/// An equilateral triangle of the given circumradius in any orientation and any of the colours.
void add_turned_triangle(Scene& scene, const Double3& centre, double radius,
                         std::span<const Color> colors, Pcg32& random) {
    const auto [u, v] = random_orientation(random);
    const double half = 0.5 * radius, wide = std::sqrt(0.75) * radius;
    add_triangle(scene, centre + radius * u, centre - half * u + wide * v,
                 centre - half * u - wide * v, any_of(colors, random));
}

void add_random_triangle(Scene& scene, double radius, Pcg32& random) {
    const Double3 centre = in_unit_cube(random);
    add_turned_triangle(scene, centre, radius, confetti, random);
}

void look_at_unit_cube(Scene& scene) {
    scene.camera = {
        .eye = {1.65f, 1.25f, 2.35f}, .target = {0.5f, 0.47f, 0.5f}, .field_of_view = 32};
    scene.background = srgb(0x1E2A33);
    add_light(scene, {1.2, 2.6, 2.2}, {0.5, 0.5, 0.5}, Color{1.1f, 1.02f, 0.9f});
    add_light(scene, {-1.5, 0.6, 1.8}, {0.5, 0.5, 0.5}, Color{0.30f, 0.36f, 0.44f});
    add_eye_light(scene, Color{0.35f, 0.34f, 0.33f});
}

}  // namespace

void make_soup(Scene& scene, std::uint32_t triangles, std::uint64_t seed) {
    Pcg32 random(seed);
    const double radius = 0.6 / std::cbrt(triangles);  // a ray meets some 0.2 cbrt(N) of them
    for (std::uint32_t i = 0; i < triangles; ++i) add_random_triangle(scene, radius, random);
    look_at_unit_cube(scene);
}

/// Half of the sizes fall like 1 / sqrt(k), k = 1 .. N; the other half also by a factor of up to
/// 2^14.
void make_soup_uneven(Scene& scene, std::uint32_t triangles, std::uint64_t seed) {
    Pcg32 random(seed);
    for (std::uint32_t k = 1; k <= triangles; ++k) {
        double radius = 0.55 / std::sqrt(k);
        if (k % 2 == 0) radius *= std::exp2(-14.0 * random.uniform_double());
        add_random_triangle(scene, radius, random);
    }
    look_at_unit_cube(scene);
}

/// Straws through the cube: triangles of length 1 and width 6 / N, so that a ray meets about as
/// many for any N.
void make_slivers(Scene& scene, std::uint32_t triangles, std::uint64_t seed) {
    Pcg32 random(seed);
    const double half_width = std::min(0.02, 3.0 / triangles);
    const Color straws[] = {srgb(0xE5C98B), srgb(0xD4AC62), srgb(0xC48F4A),
                            srgb(0xEFDFB4), srgb(0xA9743C), srgb(0x6E8B5B)};
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const Double3 centre = 0.5 * (in_unit_cube(random) + Double3{0.5});
        const auto [along, across] = random_orientation(random);
        add_triangle(scene, centre + 0.5 * along, centre - 0.5 * along + half_width * across,
                     centre - 0.5 * along - half_width * across, straws[random.below(6)]);
    }
    look_at_unit_cube(scene);
}

/// A galaxy of specks, each far smaller than the gap to the next one: to a structure they are
/// points, and nearly all rays miss.
void make_dust(Scene& scene, std::uint32_t triangles, std::uint64_t seed) {
    Pcg32 random(seed);
    const double radius = 0.03 / std::cbrt(triangles);
    const Color core[] = {srgb(0xFFE6B0), srgb(0xFFD089), srgb(0xFFF3D8)};
    const Color arms[] = {srgb(0x9FC2E8), srgb(0xCFE0F2), srgb(0x7FA6D6), srgb(0xE8C9D8)};
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const Double3 p = in_unit_ball<3>(random);
        if (i % 4 == 0) {
            add_turned_triangle(scene, glm::dot(p, p) * p * Double3{0.32, 0.20, 0.32}, radius, core,
                                random);
            continue;
        }
        // A bar along x, each point of it turned by an angle that grows with its distance: two
        // arms. (1 - s^2, 2 s) / (1 + s^2) are cosine and sine of 2 atan s; squared, of 4 atan s.
        const Double3 bar{p.x, 0.05 * p.y, 0.32 * p.z * std::abs(p.z)};
        const double s = 1.3 * std::sqrt(bar.x * bar.x + bar.z * bar.z), one = 1.0 + s * s;
        const double c1 = (1.0 - s * s) / one, s1 = 2.0 * s / one;
        const double c2 = c1 * c1 - s1 * s1, s2 = 2.0 * s1 * c1;
        add_turned_triangle(scene, {c2 * bar.x - s2 * bar.z, bar.y, s2 * bar.x + c2 * bar.z},
                            radius, arms, random);
    }
    scene.camera = {
        .eye = {0.3f, 1.35f, 1.75f}, .target = {0.03f, -0.03f, 0.1f}, .field_of_view = 38};
    scene.background = srgb(0x070B14);
    add_eye_light(scene, Color{3.5f, 3.5f, 3.5f});
    add_light(scene, {0.0, 0.7, 0.0}, {0.5, 0.0, 0.5}, Color{0.9f, 0.8f, 0.7f});
}

/// Confetti that falls on a blanket: one huge slanted triangle, whose box holds all the others.
void make_blanket(Scene& scene, std::uint32_t triangles, std::uint64_t seed) {
    Pcg32 random(seed);
    const Double3 a{-9.0, -2.8, 7.0}, b{9.0, -3.8, 6.0}, c{0.5, 5.6, -11.0};
    add_triangle(scene, a, b, c, srgb(0x35596E));
    const Double3 middle = (a + b + c) / 3.0, along = glm::normalize(b - a),
                  up = glm::normalize(glm::cross(b - a, c - a)), back = glm::cross(up, along);
    const double radius = 1.5 / std::sqrt(triangles);
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const glm::dvec2 p = in_unit_ball<2>(random);
        const double u = random.uniform_double(), height = 1.1 * radius + 0.7 * u * u * u;
        add_turned_triangle(scene, middle + p.x * along + p.y * back + height * up, radius,
                            confetti, random);
    }
    scene.camera = {.eye = Point3(middle + Double3{0.3, 1.15, 2.1}),
                    .target = Point3(middle + Double3{0.0, 0.12, 0.0}),
                    .field_of_view = 40};
    scene.background = srgb(0xC9DEE8);
    add_light(scene, middle + Double3{-2.5, 3.6, 1.8}, middle, Color{0.95f, 0.88f, 0.76f});
    add_light(scene, middle + Double3{3.0, 2.2, 1.0}, middle, Color{0.22f, 0.26f, 0.32f});
    add_eye_light(scene, Color{0.25f, 0.25f, 0.26f});
}

/// A town of axis-aligned boxes, one beside the other: every face lies in an axis-parallel plane.
void make_boxes(Scene& scene, std::uint32_t boxes, std::uint64_t seed) {
    Pcg32 random(seed);
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(boxes)));
    const Color walls[] = {srgb(0xD9CBB3), srgb(0xC8553D), srgb(0xE0A458), srgb(0x8FA3AD),
                           srgb(0x3D7C88), srgb(0xEFE6D6), srgb(0x5C6B73)};
    add(scene, box({-1.1, -0.05, -1.1}, {1.1, -0.001, 1.1}), srgb(0x7C8A6E));
    const double cell = 2.0 / side;
    for (std::uint32_t i = 0; i < boxes; ++i) {
        const double x = -1.0 + cell * (i % side), z = -1.0 + cell * (i / side);
        const double west = 0.06 + 0.14 * random.uniform_double(),
                     east = 0.80 + 0.14 * random.uniform_double();
        const double north = 0.06 + 0.14 * random.uniform_double(),
                     south = 0.80 + 0.14 * random.uniform_double();
        const double away = std::hypot(x + 0.5 * cell, z + 0.5 * cell), u = random.uniform_double();
        const double height = cell * (0.4 + 2.6 * u * u + 3.0 * u * std::exp(-4.0 * away * away));
        add(scene,
            box({x + west * cell, 0, z + north * cell},
                {x + east * cell, height, z + south * cell}),
            walls[random.below(7)]);
    }
    scene.camera = {
        .eye = {1.75f, 1.55f, 2.3f}, .target = {0.0f, -0.04f, 0.08f}, .field_of_view = 38};
    scene.background = srgb(0xC9DEE8);
    add_light(scene, {-2.6, 3.2, 1.6}, {0, 0, 0}, Color{0.95f, 0.86f, 0.70f});
    add_light(scene, {3.0, 2.0, -1.0}, {0, 0, 0}, Color{0.20f, 0.24f, 0.30f});
    add_eye_light(scene, Color{0.22f, 0.23f, 0.26f});
}

/// "Teapot in a stadium": nearly all triangles in a hundredth of the hall's length.
void make_stadium(Scene& scene, std::uint32_t detail, std::uint64_t) {
    constexpr double length = 120.0, width = 80.0, height = 24.0;  // metres
    add(scene,
        turned_inside_out(
            box({-0.5 * length, 0, -0.5 * width}, {0.5 * length, height, 0.5 * width})),
        srgb(0x9DB7C4));
    add(scene, parallelogram({-34, 0.01, 22}, {68, 0, 0}, {0, 0, -44}), srgb(0x5E8F57));
    constexpr int rows = 12;
    const Color seats[] = {srgb(0x3D6C88), srgb(0xC8553D), srgb(0xE9E1D0)};
    for (int row = 0; row < rows; ++row) {  // rows of seats, rising outwards, on all four sides
        const double inner = 24.0 + 1.2 * row, top = 0.6 * (row + 1);
        const Color& color = seats[row / 2 % 3];
        for (const double side : {-1.0, 1.0}) {
            add(scene,
                box({-0.5 * length, 0, side > 0 ? inner : -inner - 1.2},
                    {0.5 * length, top, side > 0 ? inner + 1.2 : -inner}),
                color);
            const double end = inner + 16.0;
            add(scene,
                box({side > 0 ? end : -end - 1.2, 0, -22}, {side > 0 ? end + 1.2 : -end, top, 22}),
                color);
        }
    }
    add(scene, box({-0.3, 0.01, -0.3}, {0.3, 0.9, 0.3}), srgb(0xEDE6DA));
    add(scene, transformed(teapot(detail), 1.4 * rotation({0, 1, 0}, -25), {0, 0.9, 0}),
        srgb(0xC8752F));

    scene.camera = {
        .eye = {0.62f, 1.22f, 1.9f}, .target = {0.02f, 1.10f, 0.0f}, .field_of_view = 40};
    scene.background = srgb(0xC4DDEB);
    add_light(scene, {-30, 22, 30}, {0, 1, 0}, Color{0.72f, 0.70f, 0.66f});
    add_light(scene, {30, 22, 20}, {0, 1, 0}, Color{0.34f, 0.35f, 0.38f});
    add_light(scene, {0, 22, -25}, {0, 1, 0}, Color{0.20f, 0.20f, 0.22f});
    add_eye_light(scene, Color{0.25f, 0.24f, 0.22f});
}

void make_icosphere(Scene& scene, std::uint32_t frequency, std::uint64_t) {
    scene.mesh = icosphere(frequency);
    // One colour for each of the icosahedron's 20 faces: neighbours differ, and all faces of a
    // colour are far apart.
    const Color colors[5] = {srgb(0xD98E4A), srgb(0xC8553D), srgb(0x3D7C88), srgb(0xE7DBC3),
                             srgb(0x7FA38C)};
    constexpr int color_of[20] = {0, 1, 2, 3, 4, 2, 3, 1, 0, 4, 0, 1, 2, 3, 4, 4, 4, 4, 2, 1};
    for (std::size_t face = 0; face < scene.mesh.faces.size(); ++face)
        scene.colors.push_back(colors[color_of[face / (std::size_t{frequency} * frequency)]]);
    scene.camera = {.eye = {0.0f, 0.9f, 3.2f}, .target = {0, 0, 0}, .field_of_view = 40};
    scene.background = srgb(0x22313B);
    add_light(scene, {-2.5, 3.0, 3.0}, {0, 0, 0}, Color{0.95f, 0.9f, 0.82f});
    add_light(scene, {3.0, 0.5, 2.0}, {0, 0, 0}, Color{0.20f, 0.26f, 0.34f});
    add_light(scene, {0.0, -3.0, 1.5}, {0, 0, 0}, Color{0.10f, 0.08f, 0.08f});
}

}  // namespace space
