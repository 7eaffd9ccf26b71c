/// @file
/// Scenes whose polygons are cut in every way that fails: random, coplanar, touching, needles,
/// closed meshes.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "common/mesh.hpp"
#include "common/scenes/shapes.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <array>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace space {

inline const char* name(Grade grade) {
    constexpr const char* names[] = {"thick float", "ordered float", "ordered double", "exact"};
    return names[static_cast<int>(grade)];
}

}  // namespace space

namespace space::scenes {

/// Triangles of small whole numbers: corners on planes, edges in planes, many without area.
inline std::vector<Triangle> whole_numbers(std::uint32_t count, std::uint32_t range,
                                           std::uint64_t seed) {
    Pcg32 random(seed);
    const auto point = [&] {
        const auto x = static_cast<float>(random.below(range)),
                   y = static_cast<float>(random.below(range)),
                   z = static_cast<float>(random.below(range));
        return Point3(x, y, z);
    };
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point3 a = point(), b = point();
        triangles.push_back({a, b, point()});
    }
    return triangles;
}

/// Overlapping ones in a few slanted planes, each some twice and some turned over, with others
/// across them.
inline std::vector<Triangle> coplanar(std::uint32_t in_each, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Triangle> triangles;
    for (int plane = 0; plane < 4; ++plane) {
        const auto point = [&] {  // multiples of 2^-8: the sum is exact
            const auto x = static_cast<float>(random.below(512)) * 0x1p-8f,
                       y = static_cast<float>(random.below(512)) * 0x1p-8f;
            const float s = plane % 2 ? 0.5f : -0.25f, t = plane / 2 ? 1.0f : -0.5f;
            return Point3(x, y, s * x + t * y + 0.5f);
        };
        for (std::uint32_t i = 0; i < in_each; ++i) {
            const Point3 a = point(), b = point(), c = point();
            triangles.push_back({a, b, c});
            if (i % 3 == 0) triangles.push_back({a, b, c});
            if (i % 3 == 1) triangles.push_back({a, c, b});
        }
    }
    return triangles;
}

/// As long as the scene and ten thousand times thinner.
inline std::vector<Triangle> needles(std::uint32_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point3 a = random_point(random, 0.0f, 1.0f), b = random_point(random, 0.0f, 1.0f);
        triangles.push_back({a, b, 0.5f * (a + b) + random_point(random, -1e-4f, 1e-4f)});
    }
    return triangles;
}

/// Boxes that share corners, edges and faces; a neighbour's corner lies within an edge:
/// T-junctions.
inline std::vector<Triangle> touching() {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            add_box(triangles, Point3(i, 0.5 * j, 0), Point3(i + 1, 0.5 * j + 0.5, j == i ? 2 : 1));
    add_box(triangles, {0.5f, 0.25f, 1}, {2.5f, 1.25f, 1.5f});
    const std::vector<Triangle> grid =
        sheet(6, 1, [](int i, int j) { return Point3(0.5 * i, j, 0.75 + 0.25 * i); });
    triangles.insert(triangles.end(), grid.begin(), grid.end());
    return triangles;
}

/// A torus around the z axis: closed, not convex, vertices rounded to float.
inline std::vector<Triangle> torus(int around, int across) {
    const auto at = [&](int i, int j) {
        const double u = 2.0 * std::numbers::pi * (i % around) / around,
                     v = 2.0 * std::numbers::pi * (j % across) / across;
        return Point3(
            Double3((2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v)));
    };
    return sheet(around, across, at);
}

/// Stanford's bunny, where glmark2-data is installed; empty elsewhere.
inline std::vector<Triangle> bunny() {
    const std::filesystem::path file = "/usr/share/glmark2/models/bunny.obj";
    return std::filesystem::exists(file) ? load_mesh(file).triangles() : std::vector<Triangle>{};
}

inline std::vector<TestScene> tiling_scenes() {
    std::vector<Triangle> random_spheres = icosphere(3).triangles();
    for (const Triangle& t : moved(icosphere(2), {0.7, 0.3, 0.1}).triangles())
        random_spheres.push_back(t);
    return {{"random", soup(60, 0.6f, 1)},
            {"small random", soup(400, 0.12f, 2)},
            {"coplanar", coplanar(8, 3)},
            {"whole numbers", whole_numbers(60, 5, 4)},
            {"touching", touching()},
            {"needles", needles(60, 5)},
            {"icosphere", icosphere(6).triangles()},
            {"two spheres", random_spheres},
            {"bumpy ball", ball(3)},
            {"torus", torus(24, 12)}};
}

}  // namespace space::scenes
