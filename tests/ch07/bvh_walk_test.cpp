// Rays on which a walk could lose a hit: at faces, edges and corners of boxes, within them, from
// them, huge and tiny. Every answer must be exact arithmetic's.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/box_rays.hpp"
#include "tests/ch07/bvh_trees.hpp"
#include "tests/oracle/compare.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <fmt/format.h>
#include <gmpxx.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace space {
namespace test {
extern std::atomic<std::ptrdiff_t> allocations_left;  // tests/ch05/allocations.cpp
}
namespace {

constexpr BvhWay all_boxes{.order = BvhWay::Order::all_boxes};

/// Rays that are answered otherwise than naively; some are held against the exact oracle, too.
template <class Builder>
void check_scene(const TestScene& scene, int rays, int by_oracle) {
    const auto bvh = Bvh<Builder>::build(scene.triangles);
    const auto printed = Bvh<Builder, FilteredExact, all_boxes>::build(scene.triangles);
    const auto naive = Naive<FilteredExact>::build(scene.triangles);
    const ExactOracle oracle = ExactOracle::build(scene.triangles);
    BoxRays maker(bvh.nodes(), scene.triangles, 17);
    INFO(scene.name);
    for (int i = 0; i < rays; ++i) {
        auto [kind, ray] = maker.next();
        if (ray.direction == Vector3(0.0f)) continue;
        if (i % 7 == 0) ray.tmin = -infinity;
        const auto expected = closest_hit(naive, ray), got = closest_hit(bvh, ray);
        if (expected && i % 5 == 0) ray.tmax = expected->t;
        CAPTURE(kind, i, expected.has_value() ? expected->t : -1.0f,
                got.has_value() ? got->t : -1.0f);
        REQUIRE(got == expected);
        REQUIRE(closest_hit(bvh, ray) == expected);
        REQUIRE(any_hit(bvh, ray) == expected.has_value());
        if (i % 4 == 0) REQUIRE(closest_hit(printed, ray) == expected);
        if (i % 4 == 0) REQUIRE(any_hit(printed, ray) == expected.has_value());
        if (i % std::max(1, rays / by_oracle) == 0) REQUIRE(!compare(oracle, ray, got).is_wrong());
    }
}

template <class Builder>
void check_all(int rays, int by_oracle) {
    std::vector<TestScene> all = extreme_scenes();
    for (TestScene& scene : some_of(adversarial_scenes())) all.push_back(std::move(scene));
    for (const TestScene& scene : all) check_scene<Builder>(scene, rays, by_oracle);
}

/// What an observer is told of a walk.
struct Visits : NoObserver {
    using NoObserver::observe;
    void observe(const BvhVisit& visit) { all.push_back(visit); }
    std::vector<BvhVisit> all;
};

/// The box has a point of the line with t >= 0, in exact arithmetic.
bool exactly_meets(const Ray& ray, const Aabb& box) {
    mpq_class enter = 0, leave = std::numeric_limits<double>::max();
    for (int axis = 0; axis < 3; ++axis) {
        const mpq_class o(ray.origin[axis]), d(ray.direction[axis]), low(box.min[axis]),
            high(box.max[axis]);
        if (d == 0) {
            if (o < low || o > high) return false;
            continue;
        }
        mpq_class near = (low - o) / d, far = (high - o) / d;
        if (d < 0) std::swap(near, far);
        enter = std::max(enter, near), leave = std::min(leave, far);
    }
    return enter <= leave;
}

/// A float of any size between 2^-exponents and 2^exponents, or 0.
float number(Pcg32& random, int exponents) {
    const float mantissa = random.uniform(1.0f, 2.0f);
    const int exponent = int(random.below(std::uint32_t(2 * exponents))) - exponents;
    const std::uint32_t kind = random.below(16);
    return kind == 0 ? 0.0f : std::ldexp(kind % 2 ? mantissa : -mantissa, exponent);
}

}  // namespace

TEST_CASE("rays at faces, edges and corners of boxes, and within them, are answered exactly") {
    const int rays = sized(2'000, 150), by_oracle = sized(100, 20);
    check_all<BinnedBuilder>(rays, by_oracle);
    check_all<MedianBuilder>(rays / 4, by_oracle / 4);
}

TEST_CASE("the same with 400,000 rays a scene, 100,000 of them by the oracle", "[.big]") {
    check_all<BinnedBuilder>(400'000, 100'000);
}

TEST_CASE(
    "a box that the ray meets in exact arithmetic is never passed; without margins some are") {
    Pcg32 random(1);
    std::size_t met = 0, lost = 0;
    for (int i = 0; i < sized(300'000, 3'000); ++i) {
        const int exponents = i % 3 == 0 ? 2 : i % 3 == 1 ? 12 : 60;
        Aabb box;
        for (int corner = 0; corner < 2; ++corner) {
            Point3 p;
            for (int axis = 0; axis < 3; ++axis) p[axis] = number(random, exponents);
            box.extend(p);
        }
        Ray ray;
        for (int axis = 0; axis < 3; ++axis) ray.origin[axis] = number(random, exponents);
        for (int axis = 0; axis < 3; ++axis) {
            const float plane = (random.below(2) != 0 ? box.max : box.min)[axis];
            ray.direction[axis] = plane - ray.origin[axis];  // towards a corner, but for roundings
        }
        const BvhRay<3> safe(ray), plain(ray, BoxMargins::none);
        if (!is_valid(ray) || !safe.is_safe(ray, box) || !exactly_meets(ray, box)) continue;
        REQUIRE(safe.span_in(box, safe.limit()).is_met());
        ++met, lost += !plain.span_in(box, plain.limit()).is_met();
    }
    fmt::print("  of {} boxes met at a corner, {} would be passed without margins\n", met, lost);
    CHECK(met > std::size_t(sized(50'000, 500)));
    CHECK(lost > met / 1'000);
}

TEST_CASE(
    "what begins half a place beyond the ray's end, or ends half a place before its start, "
    "is met") {
    Pcg32 random(2);
    for (int i = 0; i < sized(100'000, 2'000); ++i) {
        const int exponent = int(random.below(250)) - 126;
        const float t = std::ldexp(random.uniform(1.0f, 2.0f), exponent);
        // The point at t of this ray is speed t, rounded: the box begins, or ends, there. Some
        // reciprocals of speeds are rounded up, some down.
        const auto speed = float(3 + 2 * random.below(50));
        const Ray ray{.direction = {speed, 0.0f, 0.0f}, .tmin = t, .tmax = t};
        const float x = speed * t;
        if (!std::isfinite(x)) continue;
        const double exact = double{x} / double{speed};
        if (static_cast<float>(exact) != t) continue;
        const BvhRay<3> prepared(ray);
        const Aabb beyond{{x, 0, 0}, {infinity, 0, 0}}, before{{-infinity, 0, 0}, {x, 0, 0}};
        REQUIRE(prepared.span_in(beyond, prepared.limit()).is_met());
        REQUIRE(prepared.span_in(before, prepared.limit()).is_met());
    }
}

TEST_CASE("where a float difference of plane and origin overflows the ray is answered in double") {
    // From -3e38 to 3e38, 7.5 times the direction, whose reciprocal is a normal float. The other
    // triangle is no farther than floats reach, and is not hit.
    const float far = 3e38f, other = -1e38f;
    const std::vector<Triangle> walls{{{far, -1, -1}, {far, 1, -1}, {far, 0, 1}},
                                      {{other, 2, 2}, {other, 3, 2}, {other, 2, 3}}};
    for (const float sign : {1.0f, -1.0f}) {  // beyond the upper end of all boxes, and the lower
        const auto triangles =
            scenes::mapped(walls, [&](const Point3& p) { return Point3(sign * p.x, p.y, p.z); });
        const auto bvh =
            Bvh<BinnedBuilder>::build(triangles, {.costs = {0.0, 1.0}, .max_leaf_size = 1});
        const Ray ray{
            .origin = {-sign * far, 0, 0}, .direction = {sign * 8e37f, 0, 0}, .tmax = 8.0f};
        const auto expected = closest_hit(Naive<FilteredExact>::build(triangles), ray);
        REQUIRE(expected.has_value());
        CHECK(expected->t == 7.5f);
        CHECK(closest_hit(bvh, ray) == expected);
        CHECK(any_hit(bvh, ray));
    }
}

TEST_CASE("both ways come to the same leaves, as long as nothing ends a walk") {
    const auto triangles = scenes::soup(300, 0.2f, 21);
    const BvhNodes<3> tree = BinnedBuilder::build<3>(triangles);
    BoxRays maker(tree, triangles, 5);
    for (int i = 0; i < sized(5'000, 300); ++i) {
        Ray ray = maker.next().ray;
        if (i % 2 == 0) ray.tmax = std::max(ray.tmin, 0.1f * float(i % 20));  // that ends, if early
        std::vector<std::uint32_t> nearest_first, printed;
        NoCounts none;
        walk_bvh(tree, ray, none, [&](const BvhNode<3>& leaf) {
            nearest_first.push_back(leaf.first);
            return double{infinity};
        });
        walk_bvh<all_boxes>(tree, ray, none, [&](const BvhNode<3>& leaf) {
            printed.push_back(leaf.first);
            return double{infinity};
        });
        std::ranges::sort(nearest_first);
        REQUIRE(nearest_first == printed);
    }
}

TEST_CASE(
    "a hit ends the walk: nothing that begins beyond it is visited, and children come in the "
    "order in which the ray enters them") {
    const auto triangles = scenes::soup(300, 0.2f, 23);
    const BvhNodes<3> tree = BinnedBuilder::build<3>(triangles);
    std::vector<std::uint32_t> sibling(tree.nodes.size());
    for (std::uint32_t i = 2; i < tree.nodes.size(); ++i) sibling[i] = i ^ 1u;
    BoxRays maker(tree, triangles, 9);
    std::size_t pairs = 0;
    for (int i = 0; i < sized(3'000, 300); ++i) {
        Ray ray = maker.next().ray;
        ray.tmin = i % 2 == 0 ? 0.0f : -0.5f;  // in float, and in double
        bool named = false;
        struct Watcher : Visits {
            using Visits::observe;
            void observe(const BvhVisit& visit) {
                if (named) REQUIRE(visit.enter <= 0.5);
                Visits::observe(visit);
            }
            const bool& named;
        } watcher{{}, named};
        TraversalCounts counts;
        const auto own = [&](const BvhNode<3>&) { return named = true, 0.5; };
        walk_bvh(tree, ray, counts, own, watcher);
        CHECK(counts.nodes_visited == watcher.all.size());
        for (std::size_t a = 0; a < watcher.all.size(); ++a)
            for (std::size_t b = a + 1; b < watcher.all.size(); ++b)
                if (watcher.all[b].node == sibling[watcher.all[a].node]) {
                    ++pairs;
                    REQUIRE(watcher.all[a].enter <= watcher.all[b].enter);
                }
    }
    CHECK(pairs > 1'000 / sized(1u, 10u));
}

TEST_CASE("no ray allocates memory") {
    const auto triangles = scenes::soup(500, 0.1f, 24);
    const auto bvh = Bvh<BinnedBuilder>::build(triangles);
    BoxRays maker(bvh.nodes(), triangles, 3);
    std::vector<Ray> rays;
    for (int i = 0; i < 2'000; ++i) rays.push_back(maker.next().ray);
    std::size_t hits = 0;
    test::allocations_left = 0;  // the next one throws
    for (const Ray& ray : rays) hits += closest_hit(bvh, ray).has_value();
    for (const Ray& ray : rays) hits += any_hit(bvh, ray);
    test::allocations_left = -1;
    CHECK(hits > 500);
}

}  // namespace space
