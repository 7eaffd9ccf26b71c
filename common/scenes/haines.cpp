/// @file
/// Haines's procedural databases as triangles (Haines 1987, "A Proposed Standard Set of Problems to
/// Test Ray Tracing Algorithms", IEEE CG&A 7:11; the public-domain package's later scenes too).
/// Shapes, sizes and cameras are the published ones; tessellation, colours and lights are ours. z
/// is up.
#include "common/pcg32.hpp"
#include "common/scenes/makers.hpp"
#include "common/scenes/shapes.hpp"

#include <array>
#include <cmath>
#include <numbers>

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
    const glm::dmat3 tilt =
        rotation({a, -a, 0}, std::asin(2.0 / std::sqrt(6.0)) * 180.0 / std::numbers::pi);
    std::vector<Double3> directions;  // of the nine, where the parent's is +z
    for (int turn = 0; turn < 3; ++turn)
        for (const Double3& d : {Double3{a, a, 0}, Double3{a, 0, -a}, Double3{0, a, -a}})
            directions.push_back(glm::normalize(rotation({0, 0, 1}, 120 * turn) * (tilt * d)));

    add(scene, parallelogram({-12, -12, -0.5}, {24, 0, 0}, {0, 24, 0}), srgb(0xB9B2A3));
    const Color colors[] = {srgb(0xE9C46A), srgb(0xE08E45), srgb(0xC8553D), srgb(0x8C4A5E),
                            srgb(0x4F5D8A), srgb(0x3E8E8C), srgb(0xB5C99A)};
    constexpr std::uint32_t frequencies[] = {8, 4, 2, 2, 2, 2, 2};  // of the spheres of each level
    const auto grow = [&](const auto& self, const Double3& centre, double radius,
                          const Double3& direction, std::uint32_t level) -> void {
        add(scene, ball(centre, radius, frequencies[level]), colors[level]);
        if (level == depth) return;
        const glm::dmat3 turn = from_z_to(direction);
        for (const Double3& d : directions) {
            const Double3 outwards = turn * d;
            self(self, centre + outwards * (radius * (1.0 + 1.0 / 3.0)), radius / 3.0, outwards,
                 level + 1);
        }
    };
    grow(grow, Double3{0.0}, 0.5, {0, 0, 1}, 0);

    scene.camera = {.eye = {2.1f, 1.3f, 1.7f},
                    .target = {0.05f, 0.0f, -0.02f},
                    .up = {0, 0, 1},
                    .field_of_view = 38};
    scene.background = srgb(0xCFE0EA);
    add_light(scene, {4, 3, 2}, {0, 0, 0}, Color{0.75f, 0.70f, 0.62f});
    add_light(scene, {1, -4, 4}, {0, 0, 0}, Color{0.28f, 0.30f, 0.34f});
    add_light(scene, {-3, 1, 5}, {0, 0, 0}, Color{0.28f, 0.28f, 0.28f});
    add_eye_light(scene, Color{0.12f, 0.12f, 0.14f});
}

/// Sierpinski's tetrahedron on alternate corners of a cube: 4^depth triangles. Its tetrahedra touch
/// in points.
void make_tetra(Scene& scene, std::uint32_t depth, std::uint64_t) {
    const Double3 corners[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const Color colors[4] = {srgb(0xC8553D), srgb(0xE0A458), srgb(0x3D7C88), srgb(0xE7DBC3)};
    const auto divide = [&](const auto& self, const Double3& centre, double half,
                            std::uint32_t level, std::uint32_t quarter) -> void {
        if (level < depth) {
            for (std::uint32_t i = 0; i < 4; ++i)
                self(self, centre + 0.5 * half * corners[i], 0.5 * half, level + 1,
                     level == 1 ? i : quarter);
            return;
        }
        TriangleMesh mesh;
        for (const Double3& corner : corners) mesh.vertices.emplace_back(centre + half * corner);
        mesh.faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
        add(scene, mesh, colors[quarter]);
    };
    divide(divide, Double3{0.0}, 1.0, 1, 0);

    scene.camera = {.eye = {1.022846f, -3.177154f, -2.174512f},
                    .target = {-0.23f, -0.17f, 0.07f},
                    .up = {-0.816497f, -0.816497f, 0.816497f},
                    .field_of_view = 37};
    scene.background = srgb(0x22313B);
    add_light(scene, {1.8, -4.0, 1.5}, {0, 0, 0}, Color{0.85f, 0.80f, 0.70f});
    add_light(scene, {4.0, -1.0, -4.0}, {0, 0, 0}, Color{0.25f, 0.30f, 0.36f});
    add_eye_light(scene, Color{0.30f, 0.28f, 0.28f});
}

/// A tree after Aono & Kunii 1984: a trunk of length 1 forks into branches of 0.65 and 0.7 of it,
/// tilted by 40 and 25 degrees, and so on; each is a cone with a sphere at its end. A tiny tree on
/// a huge field.
void make_tree(Scene& scene, std::uint32_t depth, std::uint64_t) {
    add(scene, parallelogram({-50, -50, 0}, {100, 0, 0}, {0, 100, 0}), srgb(0x9DB67C));
    const Color bark = srgb(0x6B4A33);
    const Color leaves[] = {srgb(0x4F7F3F), srgb(0x6E9C45), srgb(0x88AF4B), srgb(0xD98A3D),
                            srgb(0xC9573B)};
    std::uint32_t leaf = 0;
    constexpr double widths_per_length = 0.15, thinning = 0.67;
    // `frame` turns and scales the branch's own system, in which it is (0, 0, 0) to (0, 0, 1).
    const auto grow = [&](const auto& self, const Double3& base, const glm::dmat3& frame,
                          double radius, std::uint32_t level) -> void {
        const Double3 end = base + frame[2];
        const bool last = level == depth;
        const Color color = last ? leaves[leaf++ % 5] : bark;
        add(scene, tube({base, radius}, {end, radius * thinning}, 8, false),
            last ? srgb(0x5E7A3A) : bark);
        add(scene, ball(end, last ? 0.4 * glm::length(frame[2]) : radius * thinning, 1), color);
        if (last) return;
        self(self, end,
             frame * rotation({0, 0, 1}, 90) * rotation({1, 0, 0}, 40) * glm::dmat3(0.65),
             radius * thinning, level + 1);
        self(self, end,
             frame * rotation({0, 0, 1}, 230) * rotation({1, 0, 0}, 25) * glm::dmat3(0.70),
             radius * thinning, level + 1);
    };
    grow(grow, {0, 0, 0}, glm::dmat3(1.0), 0.5 * widths_per_length, 0);

    scene.camera = {.eye = {4.5f, 0.4f, 2.0f},
                    .target = {0.0f, 0.05f, 1.45f},
                    .up = {0, 0, 1},
                    .field_of_view = 40};
    scene.background = srgb(0xBFDCEC);
    // Far away, like the sun and the sky, so that the whole field is lit.
    add_light(scene, {500, -350, 700}, {0, 0, 1}, Color{0.85f, 0.79f, 0.68f});
    add_light(scene, {100, 600, 500}, {0, 0, 1}, Color{0.22f, 0.25f, 0.30f});
    add_light(scene, {600, 50, 260}, {0, 0, 1}, Color{0.20f, 0.21f, 0.22f});
}

namespace {

/// Midpoint displacement (Fournier, Fussell & Carpenter 1982) with fractal dimension 2.2: the
/// heights of (n + 1)^2 points, row by row; n is a power of 2.
std::vector<double> displaced_heights(std::uint32_t n, std::uint64_t seed) {
    std::vector<double> heights(std::size_t{n + 1} * (n + 1), 0.0);
    const auto height = [&](std::uint32_t x, std::uint32_t y) -> double& {
        return heights[std::size_t{y} * (n + 1) + x];
    };
    // Gaussian enough: the sum of 12 uniform numbers, of a stream of its own for each point.
    const auto displacement = [&](std::uint32_t x, std::uint32_t y) {
        Pcg32 random(seed, (std::uint64_t{x} << 32) | y);
        double sum = -6.0;
        for (int i = 0; i < 12; ++i) sum += random.uniform_double();
        return sum;
    };
    const double dimension = 2.2, ratio = 2.0 / std::pow(2.0, 1.0 / (dimension - 1.0));
    const double roughness = std::sqrt(ratio * ratio - 1.0);
    double half_side = 1.0;
    for (std::uint32_t step = n / 2; step > 0; step /= 2, half_side /= 2) {
        const double rise = half_side * roughness;
        for (std::uint32_t y = step; y < n; y += 2 * step)
            for (std::uint32_t x = step; x < n; x += 2 * step)
                height(x, y) = 0.25 * (height(x - step, y - step) + height(x + step, y - step) +
                                       height(x - step, y + step) + height(x + step, y + step)) +
                               std::sqrt(2.0) * rise * displacement(x, y);
        for (std::uint32_t y = 0; y <= n; y += step)
            for (std::uint32_t x = (y / step) % 2 == 0 ? step : 0; x <= n; x += 2 * step) {
                const bool along_x =
                    (x / step) % 2 == 1;  // the midpoint of an edge that runs along x
                const double ends = along_x ? height(x - step, y) + height(x + step, y)
                                            : height(x, y - step) + height(x, y + step);
                height(x, y) = 0.5 * ends + rise * displacement(x, y);
            }
    }
    return heights;
}

}  // namespace

/// "mount": a square of 4^depth cells, each two triangles, raised at random; above it four balls.
void make_mount(Scene& scene, std::uint32_t depth, std::uint64_t seed) {
    const std::uint32_t n = 1u << depth;
    const std::vector<double> heights = displaced_heights(n, seed);
    TriangleMesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x)
            mesh.vertices.emplace_back(2.0 * x / n - 1.0, 2.0 * y / n - 1.0,
                                       heights[std::size_t{y} * (n + 1) + x]);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = b + n + 1, d = a + n + 1;
            for (const auto& face : {std::array{a, b, c}, std::array{a, c, d}}) {
                mesh.faces.push_back(face);
                const double middle =
                    (heights[face[0]] + heights[face[1]] + heights[face[2]]) / 3.0;
                scene.colors.push_back(middle > 0.28    ? srgb(0xF2F4F5)
                                       : middle > 0.12  ? srgb(0x9A8F84)
                                       : middle > -0.12 ? srgb(0x7E8C54)
                                                        : srgb(0x5F7F4A));
            }
        }
    scene.mesh = std::move(mesh);
    const double r = 0.17, apart = r;  // the pyramid of four balls that touch each other
    const Color colors[] = {srgb(0xC8553D), srgb(0xE0A458), srgb(0x3D7C88), srgb(0xE7DBC3)};
    const Double3 places[] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    for (int i = 0; i < 4; ++i)
        add(scene, ball(Double3{-0.8, 0.8, 1.0} + places[i] * (apart / std::sqrt(2.0)), r, 6),
            colors[i]);

    scene.camera = {.eye = {-2.9f, -0.55f, 1.75f},
                    .target = {-0.15f, 0.16f, 0.26f},
                    .up = {0, 0, 1},
                    .field_of_view = 43};
    scene.background = srgb(0xC4DDEB);
    add_light(scene, {-2.0, -6.0, 4.5}, {0, 0, 0}, Color{0.85f, 0.78f, 0.68f});
    add_eye_light(scene, Color{0.25f, 0.28f, 0.33f});
}

/// A lattice of (cells + 1)^3 balls joined by rods along the axes.
void make_lattice(Scene& scene, std::uint32_t cells, std::uint64_t) {
    const double ball_radius = 1.0 / (4.0 * cells), rod_radius = 1.0 / (16.0 * cells);
    const auto place = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        return Double3{x, y, z} / double(cells);
    };
    const Color rods[3] = {srgb(0xB86B4B), srgb(0x5B8C85), srgb(0x586F9E)};
    for (std::uint32_t z = 0; z <= cells; ++z)
        for (std::uint32_t y = 0; y <= cells; ++y)
            for (std::uint32_t x = 0; x <= cells; ++x) {
                const Double3 centre = place(x, y, z);
                add(scene, ball(centre, ball_radius, 3), srgb(0xE5D3A8));
                const Double3 ends[3] = {place(x + 1, y, z), place(x, y + 1, z),
                                         place(x, y, z + 1)};
                const std::uint32_t index[3] = {x, y, z};
                for (int axis = 0; axis < 3; ++axis)
                    if (index[axis] < cells)
                        add(scene, tube({centre, rod_radius}, {ends[axis], rod_radius}, 8, false),
                            rods[axis]);
            }
    scene.camera = {.eye = {-0.62f, -0.85f, 1.5f},
                    .target = {0.50f, 0.47f, 0.40f},
                    .up = {0, 0, 1},
                    .field_of_view = 48};
    scene.background = srgb(0x22313B);
    add_light(scene, {-1.6, -1.0, 2.6}, {0.5, 0.5, 0.5}, Color{0.80f, 0.75f, 0.66f});
    add_light(scene, {2.2, -1.6, 1.2}, {0.5, 0.5, 0.5}, Color{0.20f, 0.25f, 0.32f});
    add_eye_light(scene, Color{0.28f, 0.28f, 0.28f});
}

/// A sea shell of balls along a spiral (Pickover 1989): sizes over orders of magnitude, and each
/// ball overlaps many.
void make_shells(Scene& scene, std::uint32_t depth, std::uint64_t) {
    const int steps = 180 << depth;
    const Color colors[] = {srgb(0xF1DFC4), srgb(0xE3B98C), srgb(0xC98A63), srgb(0xA8645A)};
    const TriangleMesh unit = icosphere(2);
    for (int i = -2 * steps / 3; i <= steps / 3; ++i) {
        const double angle = 18.0 * std::numbers::pi * i / steps, r = std::exp(0.15 * angle);
        const Double3 centre{r * std::sin(angle), r * std::cos(angle), -2.0 * r};
        const int stripe = (i + steps) * 90 / steps;  // ten stripes a turn
        add(scene, transformed(unit, glm::dmat3(r), centre), colors[stripe % 4]);
    }
    scene.camera = {.eye = {-6, -60, 35},
                    .target = {-1.5f, 0.0f, -25.0f},
                    .up = {0, 0, 1},
                    .field_of_view = 36};
    scene.background = srgb(0x2A4453);
    add_light(scene, {-40, -45, 60}, {0, 0, -15}, Color{0.80f, 0.75f, 0.67f});
    add_light(scene, {50, -30, 10}, {0, 0, -15}, Color{0.18f, 0.22f, 0.28f});
    add_eye_light(scene, Color{0.20f, 0.20f, 0.20f});
}

}  // namespace space
