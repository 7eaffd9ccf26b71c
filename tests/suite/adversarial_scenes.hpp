/// @file
/// Small scenes on which structures fail (the reasons stand with each), the same on every machine.
#pragma once

#include "common/geometry.hpp"
#include "common/random.hpp"

#include <glm/common.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace space {

struct TestScene {
    std::string name;
    std::vector<Triangle> triangles;
};

namespace scenes {

/// Triangles of about the given size with their middles in the unit cube.
inline std::vector<Triangle> soup(std::uint32_t count, float size, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point3 middle = random_point(random, 0.0f, 1.0f);
        const Point3 a = middle + random_point(random, -size, size),
                     b = middle + random_point(random, -size, size);
        triangles.push_back({a, b, middle + random_point(random, -size, size)});
    }
    return triangles;
}

template <class Map>
std::vector<Triangle> mapped(std::vector<Triangle> triangles, const Map& map) {
    for (Triangle& t : triangles) t = {map(t.a), map(t.b), map(t.c)};
    return triangles;
}

/// Two triangles for each cell of a grid over heights(i, j): neighbours share edges and vertices
/// exactly.
template <class PointAt>
std::vector<Triangle> sheet(int columns, int rows, const PointAt& at) {
    std::vector<Triangle> triangles;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return triangles;
}

/// A closed bumpy ball: an octahedron, cut `levels` times into four, its vertices pushed outwards
/// by their direction.
inline std::vector<Triangle> ball(int levels) {
    std::vector<Triangle> triangles;
    for (const float x : {-1.0f, 1.0f})
        for (const float y : {-1.0f, 1.0f})
            for (const float z : {-1.0f, 1.0f}) {
                const Triangle face{{x, 0, 0}, {0, y, 0}, {0, 0, z}};
                triangles.push_back(x * y * z > 0 ? face : Triangle{face.a, face.c, face.b});
            }
    for (; levels > 0; --levels) {
        std::vector<Triangle> finer;
        for (const auto& [a, b, c] : triangles) {
            const Point3 ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, ca = (c + a) * 0.5f;
            for (const Triangle& part :
                 {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
                finer.push_back(part);
        }
        triangles = std::move(finer);
    }
    return mapped(std::move(triangles), [](const Point3& p) {
        const Double3 unit = glm::normalize(Double3(p));
        return Point3(unit * (1.0 + 0.25 * unit.x * unit.y + 0.125 * unit.z));
    });
}

/// The twelve triangles of an axis-aligned box.
inline void add_box(std::vector<Triangle>& triangles, const Point3& low, const Point3& high) {
    const auto corner = [&](int i) {
        return Point3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    };
    for (const auto& [a, b, c, d] : {std::array{0, 4, 6, 2},
                                     {1, 3, 7, 5},
                                     {0, 1, 5, 4},
                                     {2, 6, 7, 3},
                                     {0, 2, 3, 1},
                                     {4, 5, 7, 6}}) {
        triangles.push_back({corner(a), corner(b), corner(c)});
        triangles.push_back({corner(a), corner(c), corner(d)});
    }
}

}  // namespace scenes

/// Few scenes at the ends of what floats can hold, for rays that each test aims in its own way.
inline std::vector<TestScene> extreme_scenes() {
    using namespace scenes;
    std::vector<TestScene> all;
    const auto scaled = [&](std::string name, float scale, const Vector3& shift) {
        all.push_back({std::move(name), mapped(soup(60, 0.4f, 31), [&](const Point3& p) {
                           return p * scale + shift;
                       })});
    };
    scaled("largest floats", 2e38f, Vector3(-1e38f));
    scaled("denormal", 1e-43f, Vector3(0.0f));
    scaled("far away on one axis", 1.0f, Vector3(1e6f, 0.0f, 0.0f));
    all.push_back({"flat and far away", mapped(soup(60, 0.4f, 33), [](const Point3& p) {
                       return Point3(1e6f, p.y * 1e-6f, p.z * 1e-6f);
                   })});
    return all;
}

inline std::vector<TestScene> adversarial_scenes() {
    using namespace scenes;
    std::vector<TestScene> all;
    const auto add = [&](std::string name, std::vector<Triangle> triangles) {
        all.push_back({std::move(name), std::move(triangles)});
    };
    const Triangle one{{0.1f, 0.2f, 0.3f}, {0.9f, 0.3f, 0.4f}, {0.4f, 0.8f, 0.7f}};

    add("empty", {});
    add("one triangle", {one});
    // Nothing separates them: endless recursion, 0/0 in the binning of centroids.
    add("identical", std::vector<Triangle>(16, one));
    add("random", soup(250, 0.2f, 1));
    add("dense", soup(120, 1.0f, 2));
    // Sizes from 1 to 10^-4: cells that fit the small ones are crossed by the large ones.
    {
        Pcg32 random(3);
        std::vector<Triangle> triangles = soup(250, 1.0f, 4);
        for (Triangle& t : triangles) {
            const auto scale = static_cast<float>(std::pow(10.0, -4.0 * random.uniform_double()));
            t = {t.a, t.a + (t.b - t.a) * scale, t.a + (t.c - t.a) * scale};
        }
        add("uneven", std::move(triangles));
    }
    // Whole numbers: rays and splits meet edges, vertices and planes exactly, many triangles have
    // no area.
    {
        Pcg32 random(5);
        const auto coordinate = [&] { return static_cast<float>(random.below(5)); };
        const auto point = [&] {
            const float x = coordinate(), y = coordinate(), z = coordinate();
            return Point3(x, y, z);
        };
        std::vector<Triangle> triangles;
        for (int i = 0; i < 200; ++i) {
            const Point3 a = point(), b = point();
            triangles.push_back({a, b, point()});
        }
        add("whole numbers", std::move(triangles));
    }
    // One plane: boxes without thickness, a root without volume, equal t everywhere they overlap.
    add("coplanar",
        mapped(soup(80, 0.3f, 6), [](const Point3& p) { return Point3(p.x, p.y, 0.5f); }));
    add("coplanar in x",
        mapped(soup(80, 0.3f, 7), [](const Point3& p) { return Point3(0.5f, p.y, p.z); }));
    add("flat grid", sheet(7, 7, [](int i, int j) { return Point3(i, j, -0.0f); }));
    // Boxes with the same middle: no split by centroid helps.
    {
        Pcg32 random(8);
        std::vector<Triangle> triangles;
        for (int i = 0; i < 100; ++i) {
            const Point3 p = random_point(random, 0.1f, 1.0f);
            triangles.push_back({-p, {p.x, p.y, -p.z}, {p.x, -p.y, p.z}});
        }
        add("equal centroids", std::move(triangles));
    }
    // Middles on a line: two axes without extent.
    {
        std::vector<Triangle> triangles;
        for (int i = 0; i < 100; ++i) {
            const auto x = static_cast<float>(i);
            triangles.push_back({{x, -1, -1}, {x, 1, -1}, {x, 0, 1}});
        }
        add("in a line", std::move(triangles));
    }
    // Zero area: points, segments, collinear vertices whose products do not round to zero; alone
    // and among good ones.
    {
        Pcg32 random(9);
        std::vector<Triangle> triangles;
        for (int i = 0; i < 100; ++i) {
            // Multiples of 2^-23 whose sums are exact.
            const auto fraction = [&](std::uint32_t bound) {
                return static_cast<float>(1 + random.below(bound)) * 0x1p-23f;
            };
            const auto point = [&](std::uint32_t bound) {
                const float x = fraction(bound), y = fraction(bound), z = fraction(bound);
                return Point3(x, y, z);
            };
            const Point3 a = point(1u << 22), step = point(1u << 20);
            if (i % 3 == 0) triangles.push_back({a, a, a});
            if (i % 3 == 1) triangles.push_back({a, a, a + step});
            if (i % 3 == 2) triangles.push_back({a, a + step, a + 3.0f * step});
        }
        add("zero area only", triangles);
        const std::vector<Triangle> good = soup(100, 0.3f, 10);
        triangles.insert(triangles.begin() + 50, good.begin(), good.end());
        add("zero area among good", std::move(triangles));
    }
    // Products of coordinates leave float's range, areas too.
    add("huge", mapped(soup(150, 0.3f, 11), [](const Point3& p) { return p * 1e20f; }));
    add("tiny", mapped(soup(150, 0.3f, 12), [](const Point3& p) { return p * 1e-20f; }));
    // Few bits are left for the triangles themselves.
    add("far away", mapped(soup(150, 0.3f, 13),
                           [](const Point3& p) { return p + Point3(1e5f, 5e4f, -2.5e4f); }));
    {
        Pcg32 random(14);
        std::vector<Triangle> triangles;
        for (int i = 0; i < 150; ++i) {
            const Point3 a = random_point(random, 0.0f, 1.0f),
                         along = random_point(random, -5.0f, 5.0f);
            triangles.push_back(
                {a, a + along, a + along * 0.5f + random_point(random, -1e-4f, 1e-4f)});
        }
        add("slivers", std::move(triangles));
    }
    // A vertex of one lies within the edge of another.
    {
        std::vector<Triangle> triangles = sheet(6, 1, [](int i, int j) { return Point3(i, j, 0); });
        for (int i = 0; i < 6; ++i) {
            const auto x = static_cast<float>(i);
            triangles.push_back({{x, 0, 0}, {x + 0.5f, -1, 0.25f}, {x + 0.5f, 0, 0}});
            triangles.push_back({{x + 0.5f, 0, 0}, {x + 0.5f, -1, 0.25f}, {x + 1, 0, 0}});
        }
        add("T-junctions", std::move(triangles));
    }
    // The same t in different boxes: pruning must keep what is exactly as near, the smaller index
    // wins.
    {
        std::vector<Triangle> triangles;
        for (int copy = 0; copy < 3; ++copy)
            for (const Triangle& t :
                 sheet(4, 4, [](int i, int j) { return Point3(i, j, 2) * 0.5f; }))
                triangles.push_back(copy == 1   ? Triangle{t.b, t.c, t.a}
                                    : copy == 2 ? Triangle{t.a, t.c, t.b}
                                                : t);
        for (int i = 0; i < 12; ++i) {
            const auto reach = static_cast<float>(1 + i % 3);
            triangles.push_back(
                {{-reach, -reach, 1}, {3 + reach, -reach, 1}, {1.5f, 3 + reach, 1}});
        }
        add("equal t", std::move(triangles));
    }
    // Layers one float apart: the nearest one is decided in the last bit.
    {
        std::vector<Triangle> triangles;
        float z = 1.0f;
        for (int i = 0; i < 20; ++i, z = std::nextafter(z, i % 2 ? 2.0f : 0.0f))
            triangles.push_back({{-1, -1, z}, {2, -1, z}, {0.5f, 2, z}});
        add("one float apart", std::move(triangles));
    }
    {
        std::vector<Triangle> triangles = mapped(
            soup(200, 0.3f, 15), [](const Point3& p) { return p * 0.001f + Point3(0.25f, 0, 0); });
        add_box(triangles, Point3{-100.0f, -100.0f, -10.0f}, Point3{100.0f, 100.0f, 50.0f});
        add("teapot in a stadium", std::move(triangles));
    }
    add("closed ball", ball(2));
    {
        std::vector<Triangle> triangles;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 2; ++k)
                    add_box(triangles, Point3(i, j, k), Point3(i + 1, j + 1, k + 1));
        add("touching boxes", std::move(triangles));
    }
    // Many triangles at one vertex, with coordinates that are not whole.
    {
        const Point3 hub(0.1f, 0.2f, 0.3f);
        std::vector<Triangle> triangles;
        const auto rim = [&](int k) {
            const double angle = 2.0 * std::numbers::pi * (k % 24) / 24.0;
            return Point3(static_cast<float>(0.1 + std::cos(angle)),
                          static_cast<float>(0.2 + std::sin(angle)), k % 2 ? 0.3f : 0.4f);
        };
        for (int k = 0; k < 24; ++k) triangles.push_back({hub, rim(k), rim(k + 1)});
        add("fan", std::move(triangles));
    }
    // Spans a cell that holds none of its vertices.
    {
        std::vector<Triangle> triangles = soup(100, 0.05f, 16);
        triangles.insert(triangles.begin() + 40, {{-10, -9, 0.5f}, {11, -8, 0.5f}, {0, 12, 0.5f}});
        add("one spans all", std::move(triangles));
    }
    return all;
}

/// For tests that go through them many times: sanitized, every third.
inline std::vector<TestScene> some_of(const std::vector<TestScene>& all) {
#ifdef BOOK_SANITIZED
    constexpr std::size_t step = 3;
#else
    constexpr std::size_t step = 1;
#endif
    std::vector<TestScene> some;
    for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
    return some;
}

}  // namespace space
