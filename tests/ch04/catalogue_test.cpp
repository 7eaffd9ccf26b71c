// Where k-d trees fail: of each failure a test in which the plain method fails, by how much, and
// the cure holds. (K7, two threads that split one node, is chapter 5's.)
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <set>

namespace space {
namespace {

using Rule = KdTreeConfig::Rule;
using Straddlers = KdTreeConfig::Straddlers;

#ifdef BOOK_SANITIZED
constexpr int rays = 200;
#else
constexpr int rays = 3'000;
#endif

/// A plain tree for what a catalogue's case needs, and no more: 2^depth equal cells along x.
struct Slices {
    Aabb box;
    std::vector<std::vector<std::uint32_t>> cells;
    std::span<const Triangle> triangles;

    Slices(std::span<const Triangle> all, std::size_t count,
           const std::function<bool(const Triangle&, const Aabb&)>& belongs)
        : cells(count), triangles(all) {
        for (const Triangle& t : all) box.extend(bounds(t));
        for (std::size_t i = 0; i < count; ++i)
            for (std::uint32_t k = 0; k < all.size(); ++k)
                if (belongs(all[k], cell(i))) cells[i].push_back(k);
    }
    Aabb cell(std::size_t i) const {
        Aabb part = box;
        const float width = (box.max.x - box.min.x) / float(cells.size());
        part.min.x = box.min.x + width * float(i);
        part.max.x = i + 1 == cells.size() ? box.max.x : box.min.x + width * float(i + 1);
        return part;
    }
    /// Of a ray with a direction upwards in x: cell after cell.
    std::optional<Hit> closest_hit(const Ray& ray, bool stop_at_first_hit) const {
        std::optional<Hit> nearest;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            for (const std::uint32_t k : cells[i])
                if (auto hit = FilteredExact::intersect(ray, triangles[k])) {
                    hit->triangle = k;
                    if (!nearest || nearer(*hit, *nearest)) nearest = hit;
                }
            if (nearest && (stop_at_first_hit || nearest->t <= end_of(i, ray))) break;
        }
        return nearest;
    }
    /// No triangle is tested again, and a hit beyond its cell is dropped: its own cell should find
    /// it.
    std::optional<Hit> forgetful_hit(const Ray& ray) const {
        std::set<std::uint32_t> tested;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            std::optional<Hit> nearest;
            for (const std::uint32_t k : cells[i]) {
                if (!tested.insert(k).second) continue;
                auto hit = FilteredExact::intersect(ray, triangles[k]);
                if (!hit || hit->t > end_of(i, ray)) continue;
                hit->triangle = k;
                if (!nearest || nearer(*hit, *nearest)) nearest = hit;
            }
            if (nearest) return nearest;
        }
        return std::nullopt;
    }
    float end_of(std::size_t i, const Ray& ray) const {
        return (cell(i).max.x - ray.origin.x) / ray.direction.x;
    }
};
bool has_corner_in(const Triangle& t, const Aabb& cell) {
    return cell.contains(t.a) || cell.contains(t.b) || cell.contains(t.c);
}
bool overlaps(const Triangle& t, const Aabb& cell) {
    const Aabb box = bounds(t);
    for (int axis = 0; axis < 3; ++axis)
        if (box.max[axis] < cell.min[axis] || box.min[axis] > cell.max[axis]) return false;
    return true;
}

/// A grid of 8 x 8 x 8 cells, each with a list; a ray tests the lists of the cells that it meets.
std::optional<Hit> hit_in_grid(std::span<const Triangle> triangles, const Ray& ray,
                               const std::vector<std::vector<std::uint32_t>>& lists,
                               const std::vector<Aabb>& cells) {
    std::optional<Hit> nearest;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!SlabConservative::intersect(ray, cells[i])) continue;
        for (const std::uint32_t k : lists[i])
            if (auto hit = FilteredExact::intersect(ray, triangles[k])) {
                hit->triangle = k;
                if (!nearest || nearer(*hit, *nearest)) nearest = hit;
            }
    }
    return nearest;
}

std::vector<Ray> upwards_in_x(int count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Ray> all;
    for (int i = 0; i < count; ++i) {
        const Point3 from = random_point(random, 0.0f, 1.0f), to = random_point(random, 0.0f, 1.0f);
        all.push_back({from - Point3(1.5f, 0, 0), to + Point3(1.5f, 0, 0) - from});
    }
    return all;
}

/// Rays that slices answer otherwise than the naive loop, in percent.
double wrong(const std::vector<Triangle>& triangles, const Slices& slices, bool stop_at_first_hit) {
    const auto naive = Naive<FilteredExact>::build(triangles);
    int count = 0;
    for (const Ray& ray : upwards_in_x(rays, 4))
        count += slices.closest_hit(ray, stop_at_first_hit) != closest_hit(naive, ray);
    return 100.0 * count / rays;
}
template <class Belongs>
double wrong_in_grid(const std::vector<Triangle>& triangles, const Belongs& belongs) {
    constexpr int side = 8;
    Aabb box;
    for (const Triangle& t : triangles) box.extend(bounds(t));
    std::vector<Aabb> cells;
    std::vector<std::vector<std::uint32_t>> lists;
    for (int i = 0; i < side * side * side; ++i) {
        const auto corner = [&](int step) {
            const Vector3 at(float(i % side + step), float(i / side % side + step),
                             float(i / (side * side) + step));
            return box.min + at / float(side) * box.extent();
        };
        cells.push_back({corner(0), corner(1)});
        lists.emplace_back();
        for (std::uint32_t k = 0; k < triangles.size(); ++k)
            if (belongs(triangles[k], cells.back())) lists.back().push_back(k);
    }
    const auto naive = Naive<FilteredExact>::build(triangles);
    int count = 0;
    for (const Ray& ray : upwards_in_x(rays, 4))
        count += hit_in_grid(triangles, ray, lists, cells) != closest_hit(naive, ray);
    return 100.0 * count / rays;
}
int wrong(const std::vector<Triangle>& triangles, const KdTreeConfig& config) {
    const auto naive = Naive<FilteredExact>::build(triangles);
    const auto kd = KdTree<>::build(triangles, config);
    int count = 0;
    for (const Ray& ray : upwards_in_x(rays, 4))
        count += closest_hit(kd, ray) != closest_hit(naive, ray);
    return count;
}

}  // namespace

TEST_CASE("K1: sorted by corners, triangles that span a cell are lost; by overlap none") {
    const Triangle spans{{-10, -9, 0.5f}, {11, -8, 0.5f}, {0, 12, 0.5f}};
    const Aabb unit{Point3(0), Point3(1)};
    CHECK(!has_corner_in(spans, unit));
    CHECK(!clipped_bounds<3>(spans, unit).is_empty());
    std::vector<Triangle> triangles = scenes::soup(200, 0.05f, 16);
    triangles.push_back(spans);
    const Ray ray{{0.5f, 0.5f, 2.0f}, {0, 0, -1}};
    const auto kd = KdTree<>::build(triangles);
    REQUIRE(closest_hit(kd, ray));
    CHECK(closest_hit(Naive<FilteredExact>::build(triangles), ray) == closest_hit(kd, ray));

    for (const float size : {0.05f, 0.3f, 1.0f}) {
        const auto soup = scenes::soup(200, size, 5);
        const double plain = wrong_in_grid(soup, has_corner_in),
                     cured = wrong_in_grid(soup, overlaps);
        fmt::print("  K1: triangles of size {}: by corners {:.1f} % of rays wrong, by overlap {}\n",
                   size, plain, cured);
        if (size > 0.1f) CHECK(plain > 5.0);
        CHECK(cured == 0.0);
        CHECK(wrong(soup, KdTreeConfig{}) == 0);
    }
}

TEST_CASE("K2: who stops at the first cell with any hit takes one behind it; in its cell none") {
    const auto soup = scenes::soup(200, 0.3f, 6);
    const Slices slices(soup, 32, overlaps);
    const double plain = wrong(soup, slices, true), cured = wrong(soup, slices, false);
    fmt::print("  K2: the first hit of any cell: {:.1f} % wrong; the first in its cell: {}\n",
               plain, cured);
    CHECK(plain > 1.0);
    CHECK(cured == 0.0);
    // A large slanted triangle, named in the first cell and hit behind it; a small one before.
    const std::vector<Triangle> two{{{0, -5, -5}, {8, 5, -5}, {8, 5, 20}},
                                    {{5, -1, -1}, {5, 1, -1}, {5, 0, 1}}};
    const Ray ray{{-1, 3, 0}, {2, -1, 0}};
    const auto naive = Naive<FilteredExact>::build(two);
    CHECK(closest_hit(KdTree<>::build(two, {.max_leaf_size = 1}), ray) == closest_hit(naive, ray));
}

TEST_CASE("K3: a mailbox that forgets the hit with the test loses it; ours only spares the test") {
    const std::vector<Triangle> triangles = scenes::soup(300, 0.3f, 8);
    const auto with = KdTree<>::build(triangles, {.mailboxes = true}),
               without = KdTree<>::build(triangles, {.mailboxes = false});
    const auto naive = Naive<FilteredExact>::build(triangles);
    const Slices slices(triangles, 32, overlaps);
    TraversalCounts counts_with, counts_without;
    int differ = 0, forgotten = 0;
    for (const Ray& ray : upwards_in_x(rays, 9)) {
        const auto expected = closest_hit(naive, ray);
        differ += with.closest_hit(ray, counts_with) != expected;
        differ += without.closest_hit(ray, counts_without) != expected;
        forgotten += slices.forgetful_hit(ray) != expected;
    }
    fmt::print(
        "  K3: with mailboxes {} tests, without {}; a mailbox that forgets: {} of {} wrong\n",
        counts_with.triangles_tested, counts_without.triangles_tested, forgotten, rays);
    CHECK(differ == 0);
    CHECK(counts_with.nodes_visited == counts_without.nodes_visited);
    CHECK(double(counts_with.triangles_tested) < 0.95 * double(counts_without.triangles_tested));
    CHECK(forgotten > rays / 100);
}

TEST_CASE("K4: what lies in a plane is lost by < and > on both sides; the split gives it a side") {
    const std::vector<Triangle> wall =
        scenes::sheet(4, 4, [](int i, int j) { return Point3(0.5f, float(i), float(j)); });
    std::vector<Triangle> triangles = wall;
    triangles.push_back({{0, 0, 0}, {1, 0, 0}, {0, 1, 1}});
    int strictly = 0;
    for (const Triangle& t : wall) strictly += bounds(t).max.x < 0.5f || bounds(t).min.x > 0.5f;
    CHECK(strictly == 0);  // on neither side: all are lost
    for (const bool below : {true, false}) {
        const KdSplit split[] = {{0, 0.5f, below}};
        const auto kd = KdTree<>::build(triangles, {.max_leaf_size = 1, .planned = split});
        const auto naive = Naive<FilteredExact>::build(triangles);
        int differ = 0;
        for (int y = 0; y <= 8; ++y)
            for (int z = 0; z <= 8; ++z)
                for (const float x : {-3.0f, 3.0f}) {
                    const Ray ray{{x, 0.5f * float(y), 0.5f * float(z)}, {-x, 0, 0}};
                    REQUIRE(closest_hit(naive, ray).has_value());
                    differ += closest_hit(kd, ray) != closest_hit(naive, ray);
                }
        CHECK(differ == 0);
    }
}

TEST_CASE("K5: coincident triangles are named by every leaf of a plain tree; ours stops") {
    const std::vector<Triangle> copies(
        16, {{0.1f, 0.2f, 0.3f}, {0.9f, 0.3f, 0.4f}, {0.4f, 0.8f, 0.7f}});
    for (const std::size_t depth : {4, 8, 12, 16}) {
        const auto references = [&](const KdTreeConfig& config) {
            return KdBuilder<3>::build(copies, config).references.size();
        };
        const std::size_t plain = references({.rule = Rule::middle,
                                              .straddlers = Straddlers::clip,
                                              .max_straddling = 1.0,
                                              .max_depth = depth}),
                          middle = references({.rule = Rule::middle, .max_depth = depth}),
                          sah = references({.max_depth = depth});
        fmt::print(
            "  K5: 16 copies, depth {}: {} references; only where a plane parts: {}; by area: {}\n",
            depth, plain, middle, sah);
        CHECK(plain > 8 * depth);
        if (depth >= 12) CHECK(plain > 100 * 16);
        CHECK(middle == 16);
        CHECK(sah == 16);
    }
    CHECK_THROWS_AS(KdBuilder<3>::build(copies, {.rule = Rule::middle,
                                                 .max_straddling = 1.0,
                                                 .max_depth = 20,
                                                 .max_references = 1'000}),
                    LimitError);
}

TEST_CASE("K6: of a cell without area costs are 0 / 0; lengths decide, and the build ends") {
    // All on a line: no triangle of area, no ray that hits.
    std::vector<Triangle> line;
    for (int i = 0; i < 64; ++i) {
        const auto x = float(i);
        line.push_back({{x, 0, 0}, {x + 0.25f, 0, 0}, {x + 0.5f, 0, 0}});
    }
    Aabb box;
    for (const Triangle& t : line) box.extend(bounds(t));
    CHECK(std::isnan(box.half_area() / box.half_area()));
    const SahCost<3> cost(box, 0, {});
    CHECK(cost(31.75f, 32, 32, 64) == Approx(1.0 + 32.0));
    const KdNodes<3> tree = KdBuilder<3>::build(line);
    CHECK(tree.nodes.size() > 32);
    CHECK(tree.references.size() == 64);
    // In a plane, and all in a point.
    const auto flat = scenes::sheet(8, 8, [](int i, int j) { return Point3(i, j, 0); });
    CHECK(KdBuilder<3>::build(flat).nodes.size() > 64);
    const std::vector<Triangle> points(20, {Point3(1), Point3(1), Point3(1)});
    for (const Rule rule : {Rule::middle, Rule::median, Rule::sah})
        CHECK(KdBuilder<3>::build(points, {.rule = rule}).references.size() == 20);
}

TEST_CASE("no triangles, one, points, huge and tiny ones: every rule ends, and answers") {
    for (const Rule rule : {Rule::middle, Rule::median, Rule::sah})
        for (const float scale : {1e-45f, 1e-38f, 1.0f, 1e30f, 3e38f}) {
            const KdTreeConfig config{.rule = rule};
            CHECK(!any_hit(KdTree<>::build({}, config), {{0, 0, 0}, {0, 0, 1}}));
            std::vector<Triangle> all = scenes::mapped(
                scenes::soup(40, 0.3f, 3), [&](const Point3& p) { return 0.7f * p * scale; });
            const auto kd = KdTree<>::build(all, config);
            const auto naive = Naive<FilteredExact>::build(all);
            int differ = 0;
            for (const Triangle& t : all) {
                const Ray ray{t.a, (t.b - t.a) + (t.c - t.a), -infinity, infinity};
                differ += closest_hit(kd, ray) != closest_hit(naive, ray);
            }
            CHECK(differ == 0);
        }
}

}  // namespace space
