// Geometry that is made where rays go: its sources, and that nobody can tell from the answers.
#include "chapters/ch05_lazy_kd_trees/lazy_geometry.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch05_lazy_kd_trees/heightfield.hpp"
#include "chapters/ch05_lazy_kd_trees/subdivided_mesh.hpp"
#include "common/limit_error.hpp"
#include "common/parallel.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"
#include "common/scenes/shapes.hpp"
#include "tests/catch.hpp"

#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

using namespace space;

namespace {

template <PatchSource Source>
std::vector<Triangle> all_triangles(const Source& source) {
    std::vector<Triangle> all;
    for (std::uint32_t patch = 0; patch < source.patches(); ++patch) {
        REQUIRE(source.first_triangle(patch) == all.size());
        for (const Triangle& triangle : source.triangles(patch)) all.push_back(triangle);
    }
    return all;
}

/// Counts how often each patch is made; copies count together.
template <PatchSource Source>
struct Counted {
    Source source;
    std::shared_ptr<std::vector<std::atomic<int>>> times =
        std::make_shared<std::vector<std::atomic<int>>>(source.patches());

    std::uint32_t patches() const { return source.patches(); }
    Aabb bounds(std::uint32_t patch) const { return source.bounds(patch); }
    std::uint32_t first_triangle(std::uint32_t patch) const { return source.first_triangle(patch); }
    std::vector<Triangle> triangles(std::uint32_t patch) const {
        ++(*times)[patch];
        return source.triangles(patch);
    }
};

/// Three squares, each its own patch: two behind each other, and one beside them, whose box comes
/// near the ray along x, and whose triangles do not.
struct Squares {
    std::uint32_t patches() const { return 3; }
    std::uint32_t first_triangle(std::uint32_t patch) const { return 2 * patch; }
    std::vector<Triangle> triangles(std::uint32_t patch) const {
        const float x = patch == 1 ? 4.0f : 2.0f, y = patch == 2 ? 1.5f : 0.0f;
        const Point3 a{x, y - 1, -1}, b{x, y + 1, -1}, c{x, y + 1, 1}, d{x, y - 1, 1};
        return {{a, b, c}, {a, c, d}};
    }
    Aabb bounds(std::uint32_t patch) const {
        Aabb box;
        for (const Triangle& triangle : triangles(patch)) box.extend(space::bounds(triangle));
        return box;
    }
};

/// Each triangle a patch: their boxes overlap, more than planes can part.
struct TriangleSoup {
    std::vector<Triangle> soup;

    std::uint32_t patches() const { return std::uint32_t(soup.size()); }
    std::uint32_t first_triangle(std::uint32_t patch) const { return patch; }
    std::vector<Triangle> triangles(std::uint32_t patch) const { return {soup[patch]}; }
    Aabb bounds(std::uint32_t patch) const { return space::bounds(soup[patch]); }
};

/// Within the box of all, from around it, and aimed at corners of triangles and middles of edges.
std::vector<Ray> many_rays(const std::vector<Triangle>& triangles, std::size_t count,
                           std::uint64_t seed) {
    std::vector<Ray> rays = rays_within(triangles, count, seed);
    for (const Ray& ray : rays_from_around(triangles, count, seed + 1)) rays.push_back(ray);
    Pcg32 random(seed + 2);
    for (std::size_t i = 0; i < count; ++i) {
        const Triangle& t = triangles[random.below(std::uint32_t(triangles.size()))];
        const Point3 aim = i % 2 == 0 ? t.a : 0.5f * (t.a + t.b);
        const Point3 origin = rays[i].origin;
        if (aim != origin) rays.push_back({.origin = origin, .direction = aim - origin});
    }
    return rays;
}

template <PatchSource Source>
void require_same_answers(const Source& source, std::size_t count) {
    const std::vector<Triangle> triangles = all_triangles(source);
    const auto naive = Naive<FilteredExact>::build(triangles);
    const auto lazy = LazyGeometry<Source>::build(source);
    for (const Ray& ray : many_rays(triangles, count, 7)) {
        CAPTURE(ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                ray.direction.z);
        REQUIRE((closest_hit(lazy, ray) == closest_hit(naive, ray)));
        REQUIRE(any_hit(lazy, ray) == any_hit(naive, ray));
    }
}

Heightfield field(std::uint32_t cells, std::uint32_t patch, std::uint64_t seed = 1) {
    return Heightfield({.cells = cells,
                        .patch_cells = patch,
                        .longest_wave = std::max(patch, cells / 4),
                        .shortest_wave = 4,
                        .seed = seed});
}

template <PatchSource Source>
void require_true_bounds(const Source& source) {
    for (std::uint32_t patch = 0; patch < source.patches(); ++patch) {
        Aabb box;
        for (const Triangle& triangle : source.triangles(patch)) box.extend(bounds(triangle));
        CAPTURE(patch);
        REQUIRE(source.bounds(patch).contains(box));
    }
}

}  // namespace

TEST_CASE("a wave goes from node to node by weights that can be computed by hand") {
    const Heightfield one(
        {.cells = 64, .patch_cells = 16, .longest_wave = 16, .shortest_wave = 16, .seed = 3});
    const auto node = [&](std::uint32_t i, std::uint32_t j) { return one.height(16 * i, 16 * j); };
    for (std::uint32_t i = 0; i <= 4; ++i)
        for (std::uint32_t j = 0; j <= 4; ++j) {
            REQUIRE(node(i, j) >= 0);
            REQUIRE(node(i, j) <= 4 * 64);  // a quarter of the wave, in 64ths
        }
    // In the middle both weights are 8 of 16; after 4 cells it is 4 * 4 * (48 - 8) / 256 = 2.5,
    // down to 2.
    CHECK(one.height(24, 8) == (node(1, 0) + node(2, 0) + node(1, 1) + node(2, 1)) / 4);
    CHECK(one.height(20, 16) == (14 * node(1, 1) + 2 * node(2, 1)) / 16);
    CHECK(one.height(16, 20) == (14 * node(1, 1) + 2 * node(1, 2)) / 16);
    CHECK(node(0, 0) != node(1, 0));
    CHECK(Heightfield({.cells = 64, .longest_wave = 32, .seed = 4}).height(32, 32) !=
          Heightfield({.cells = 64, .longest_wave = 32, .seed = 5}).height(32, 32));
}

TEST_CASE("all waves together are the height, and heights are exact floats") {
    const Heightfield both({.cells = 64, .patch_cells = 8, .longest_wave = 16, .shortest_wave = 8}),
        long_one({.cells = 64, .patch_cells = 8, .longest_wave = 16, .shortest_wave = 16}),
        short_one({.cells = 64, .patch_cells = 8, .longest_wave = 8, .shortest_wave = 8});
    for (std::uint32_t x = 0; x <= 64; x += 3)
        for (std::uint32_t z = 0; z <= 64; z += 5) {
            REQUIRE(both.height(x, z) == long_one.height(x, z) + short_one.height(x, z));
            REQUIRE(double{both.point(x, z).y} * 64.0 == double(both.height(x, z)));
        }
}

TEST_CASE("the cells of a field are its patches', row by row, two triangles each, front sides up") {
    const Heightfield source = field(16, 4);
    REQUIRE(source.patches() == 16);
    CHECK(source.first_triangle(5) == 5 * 32);
    const std::vector<Triangle> patch = source.triangles(5);  // the second of the second row
    REQUIRE(patch.size() == 32);
    CHECK(patch[0] == Triangle{source.point(4, 4), source.point(4, 5), source.point(5, 4)});
    CHECK(patch[1] == Triangle{source.point(4, 5), source.point(5, 5), source.point(5, 4)});
    CHECK(patch[2].a == source.point(5, 4));
    CHECK(patch[8].a == source.point(4, 5));
    for (const Triangle& triangle : patch) CHECK(normal(triangle).y == 1.0);
}

TEST_CASE("the bounds of a field's patch hold its triangles, and are little wider") {
    for (std::uint64_t seed = 1; seed <= sized(20u, 4u); ++seed) {
        const Heightfield source = field(128, 16, seed);
        require_true_bounds(source);
        for (std::uint32_t patch = 0; patch < source.patches(); ++patch) {
            Aabb box;
            for (const Triangle& triangle : source.triangles(patch)) box.extend(bounds(triangle));
            const Aabb known = source.bounds(patch);
            REQUIRE(known.min.x == box.min.x);
            REQUIRE(known.max.z == box.max.z);
            // Waves of 8 and 4 cells are a quarter as high; of two long ones each may take back
            // what the other adds, at most all of what they differ by within the patch.
            REQUIRE(box.min.y - known.min.y <= 2.0f + 1.0f + 16.0f);
        }
    }
}

TEST_CASE("the bounds of a subdivided face hold its triangles, near and far from the origin") {
    for (const double away : {0.0, 3.0, 1e4}) {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            const SubdividedMesh source(ball({away, -away, away}, 1.0, 3),
                                        {.levels = 3, .height = 0.3, .seed = seed});
            require_true_bounds(source);
        }
    }
}

TEST_CASE("the bounds of a subdivided face reach no farther than its highest bump could") {
    const TriangleMesh mesh = ball({0, 0, 0}, 1.0, 2);
    const SubdividedMesh source(mesh, {.levels = 2, .height = 0.25});
    for (std::uint32_t patch = 0; patch < source.patches(); ++patch) {
        const Aabb box = source.bounds(patch), face = bounds(mesh.triangle(patch));
        REQUIRE(box.contains(face));
        for (int axis = 0; axis < 3; ++axis) {
            REQUIRE(face.min[axis] - box.min[axis] <= 0.2500001f);
            REQUIRE(box.max[axis] - face.max[axis] <= 0.2500001f);
        }
    }
}

TEST_CASE(
    "a subdivided face's bounds hold its highest bump, where double puts that a float higher") {
    // The lowest point is 1 - 2^-25 - 2^-55. In double it is the middle between 1 and the float
    // below, and rounds up to 1.
    const double lowest_bump = 0x1p-25 + 0x1p-55;
    const TriangleMesh flat{.vertices = {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}, .faces = {{0, 1, 2}}};
    const SubdividedMesh source(flat, {.levels = 1, .height = lowest_bump});
    CHECK(source.bounds(0).min.z == 1.0f - 0x1p-24f);
    CHECK(source.bounds(0).max.z >= 1.0f);
    CHECK(source.bounds(0).max.z <= 1.0f + 0x1p-23f);
}

TEST_CASE("up to 15 levels a face's triangles are numbered by 32 bits, and more are refused") {
    const TriangleMesh flat{.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, .faces = {{0, 1, 2}}};
    const auto with = [&](std::uint32_t levels) {
        return SubdividedMesh(flat, {.levels = levels});
    };
    CHECK(with(15).patch_triangles() == 1u << 30);
    for (const std::uint32_t levels : {16u, 31u, 32u, ~0u}) {
        CHECK_THROWS_AS(with(levels), LimitError);
        CHECK_THROWS_WITH(with(levels), "subdivided mesh: more than 15 levels (levels)");
    }
}

TEST_CASE("a closed mesh stays closed when it is subdivided: each edge has its twin, bit for bit") {
    const SubdividedMesh source(ball({0.1, 0.2, 0.3}, 1.0, 2), {.levels = 3, .height = 0.4});
    using Edge = std::array<float, 6>;
    std::map<Edge, int> open;
    const auto edge = [](const Point3& a, const Point3& b) {
        return Edge{a.x, a.y, a.z, b.x, b.y, b.z};
    };
    for (const Triangle& t : all_triangles(source))
        for (int corner = 0; corner < 3; ++corner) {
            ++open[edge(t[corner], t[(corner + 1) % 3])];
            --open[edge(t[(corner + 1) % 3], t[corner])];
        }
    for (const auto& [ends, count] : open) REQUIRE(count == 0);
    CHECK(open.size() == 2 * 3 * 80 * 64 / 2);
}

TEST_CASE("neighbouring patches of a field share their borders") {
    const Heightfield source = field(32, 8);
    std::set<std::array<float, 3>> points;
    for (const Triangle& t : all_triangles(source))
        for (int corner = 0; corner < 3; ++corner)
            points.insert({t[corner].x, t[corner].y, t[corner].z});
    CHECK(points.size() == 33 * 33);  // a crack would make a point twice
}

TEST_CASE("subdividing cuts each edge in two, and keeps the first row, the order and the front") {
    const TriangleMesh flat{.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, .faces = {{0, 1, 2}}};
    const SubdividedMesh source(flat, {.levels = 1, .height = 0.0});
    CHECK(source.triangles(0) == std::vector<Triangle>{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}},
                                                       {{2, 0, 0}, {4, 0, 0}, {2, 2, 0}},
                                                       {{2, 0, 0}, {2, 2, 0}, {0, 2, 0}},
                                                       {{0, 2, 0}, {2, 2, 0}, {0, 4, 0}}});
}

TEST_CASE("a landscape answers as the naive loop over all its triangles, bit for bit") {
    require_same_answers(field(32, 8), sized(1'500, 40));
    require_same_answers(field(32, 4, 9), sized(500, 20));
}

TEST_CASE("a subdivided mesh answers as the naive loop over all its triangles, bit for bit") {
    require_same_answers(SubdividedMesh(ball({0, 0, 0}, 1.0, 2), {.levels = 2}), sized(1'500, 40));
    require_same_answers(SubdividedMesh(box({0, 0, 0}, {1, 2, 3}), {.levels = 3, .height = 0.0}),
                         sized(1'500, 40));
}

TEST_CASE("a patch is made when a ray meets its box before its nearest hit, and not else") {
    const Counted<Squares> source{.source = {}};
    const auto lazy = LazyGeometry<Counted<Squares>>::build(source);
    const auto times = [&](std::size_t patch) { return (*source.times)[patch].load(); };

    CHECK(!closest_hit(lazy, {.origin = {0, 5, 0}, .direction = {1, 0, 0}}));
    CHECK(lazy.made().patches == 0);
    const auto hit = closest_hit(lazy, {.origin = {0, 0.25f, 0}, .direction = {1, 0, 0}});
    REQUIRE(hit);
    CHECK(hit->t == 2.0f);
    CHECK(times(0) == 1);
    CHECK(times(1) == 0);  // on the ray, behind the hit
    CHECK(times(2) == 0);  // beside the ray
    const auto behind = closest_hit(lazy, {.origin = {3, 0.25f, 0}, .direction = {1, 0, 0}});
    REQUIRE(behind);
    CHECK(behind->triangle / 2 == 1);
    CHECK(times(1) == 1);
    CHECK(any_hit(lazy, {.origin = {0, 0.25f, 0}, .direction = {1, 0, 0}}));
    CHECK(times(0) == 1);
    CHECK(times(2) == 0);
    CHECK(lazy.made().patches == 2);
    CHECK(lazy.made().triangles == 4);
    CHECK(lazy.is_made(0));
    CHECK(!lazy.is_made(2));
}

TEST_CASE("a patch that only shares a cell with the ray is not made") {
    const TriangleSoup source{.soup = make_scene("soup:300", 5).mesh.triangles()};
    std::size_t made = 0;
    for (const Ray& ray : rays_from_around(source.soup, 100, 6)) {
        const auto lazy = LazyGeometry<TriangleSoup>::build(source);
        closest_hit(lazy, ray);
        for (std::uint32_t patch = 0; patch < source.patches(); ++patch) {
            if (!lazy.is_made(patch)) continue;
            ++made;
            CAPTURE(patch);
            REQUIRE(part_in(source.bounds(patch), KdRay<3>(ray), RayPart::all_of(ray)));
        }
    }
    CHECK(made == 272);  // of 300 patches by each of 100 rays; more if hits did not shorten rays
}

TEST_CASE("whoever asks for any hit makes no patch after the first one that is hit") {
    const TriangleSoup source{.soup = make_scene("soup:300", 5).mesh.triangles()};
    std::size_t hits = 0;
    for (const Ray& ray : rays_from_around(source.soup, 100, 6)) {
        const auto lazy = LazyGeometry<TriangleSoup>::build(source);
        std::size_t hit_patches = 0;
        const bool is_hit = any_hit(lazy, ray);
        for (std::uint32_t patch = 0; patch < source.patches(); ++patch)
            hit_patches += lazy.is_made(patch) && FilteredExact::intersect(ray, source.soup[patch]);
        REQUIRE(hit_patches == std::size_t(is_hit));
        hits += hit_patches;
    }
    CHECK(hits > 20);
}

TEST_CASE("lazy geometry that has been moved from is not hit") {
    auto built = LazyGeometry<Squares>::build({});
    const auto moved = std::move(built);
    const Ray ray{.origin = {0, 0.25f, 0}, .direction = {1, 0, 0}};
    CHECK(!closest_hit(built, ray));
    CHECK(!any_hit(built, ray));
    CHECK(built.made().patches == 0);
    CHECK(closest_hit(moved, ray));
}

TEST_CASE("more triangles than 32 bits can number are refused, and as many are not") {
    const auto build = [](std::uint32_t cells) {
        return LazyGeometry<Heightfield>::build(
            Heightfield({.cells = cells, .patch_cells = 1'024, .shortest_wave = 1'024}));
    };
    CHECK_NOTHROW(build(1u << 15));
    CHECK_THROWS_AS(build(1u << 16), LimitError);
}

TEST_CASE("from many threads each patch is made once, and the answers are the same") {
    const Heightfield plain = field(64, 8);
    const std::vector<Triangle> triangles = all_triangles(plain);
    const std::vector<Ray> rays = many_rays(triangles, sized(1'000, 100), 3);
    const auto alone = LazyGeometry<Heightfield>::build(plain);
    std::vector<std::optional<Hit>> truth;
    for (const Ray& ray : rays) truth.push_back(closest_hit(alone, ray));
    for (int run = 0; run < sized(20, 4); ++run) {
        const Counted<Heightfield> source{.source = plain};
        const auto lazy = LazyGeometry<Counted<Heightfield>>::build(source);
        std::atomic<std::size_t> wrong = 0;
        parallel_for(rays.size(), 8, 1, [&](std::size_t i) {
            if (closest_hit(lazy, rays[i]) != truth[i]) ++wrong;
        });
        REQUIRE(wrong == 0);
        for (std::uint32_t patch = 0; patch < source.patches(); ++patch) {
            REQUIRE((*source.times)[patch] <= 1);
            REQUIRE(((*source.times)[patch] == 1) == lazy.is_made(patch));
        }
        CHECK(lazy.made().patches == alone.made().patches);
    }
}

TEST_CASE("memory follows what rays reach, not what exists") {
    const Ray down{.origin = {100.25f, 1e4f, 100.25f}, .direction = {0, -1, 0}};
    std::vector<std::size_t> bytes;
    for (const std::uint32_t cells : {256u, 512u}) {
        const auto lazy =
            LazyGeometry<Heightfield>::build(Heightfield({.cells = cells, .longest_wave = 128}));
        const std::size_t none = lazy.made().bytes;
        REQUIRE(closest_hit(lazy, down));
        CHECK(lazy.made().patches == 1);
        CHECK(lazy.made().triangles == 2 * 32 * 32);
        bytes.push_back(lazy.made().bytes - none);
    }
    CHECK(bytes[0] == bytes[1]);  // four times as much land
}
