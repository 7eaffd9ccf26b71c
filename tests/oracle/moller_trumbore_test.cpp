// Möller-Trumbore in double against exact arithmetic: where it may be wrong, and what holds bit for
// bit.
#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/pcg32.hpp"
#include "common/program/report.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/compare.hpp"
#include "tests/oracle/moller_trumbore_bound.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <utility>

namespace space {
namespace {

constexpr int pairs = sized(20'000, 2'000);

/// The same examples on every run; RC_PARAMS in the environment asks for others.
const int seeded = ::setenv("RC_PARAMS", "seed=1 max_success=1000", 0);

struct Decisions {
    std::size_t wrong_hits = 0, wrong_misses = 0, beyond = 0;
};

/// Takes a triangle, aims at it, compares hit or miss and t with the exact ones.
template <class Aim>
Decisions decisions(std::uint64_t seed, const Aim& aim) {
    Pcg32 random(seed);
    Decisions count;
    for (int i = 0; i < pairs; ++i) {
        const Point3 a = random_point(random, -1.0f, 1.0f), b = random_point(random, -1.0f, 1.0f);
        const Triangle triangle{a, b, random_point(random, -1.0f, 1.0f)};
        const Point3 origin = random_point(random, -3.0f, 3.0f);
        const Ray ray{
            .origin = origin, .direction = aim(random, triangle) - origin, .tmin = -infinity};
        const std::optional<Hit> hit = MollerTrumbore::intersect(ray, triangle);
        const bool exact = decide(ray, triangle) != Place::miss;
        if (hit.has_value() != exact) {
            ++(exact ? count.wrong_misses : count.wrong_hits);
            count.beyond += !within_bound(ray, triangle);
        } else if (hit) {
            const auto at = crossing(ray, triangle);
            const MollerTrumboreBound bound = moller_trumbore_bound(ray, triangle, *at);
            const double half_ulp = 0x1p-24 * std::abs(at->t) + 0x1p-150;
            count.beyond += std::abs(hit->t - at->t) > bound.t + half_ulp;
            count.beyond += std::abs(hit->u - at->u) > bound.weight + 0x1p-24;
            count.beyond += std::abs(hit->v - at->v) > bound.weight + 0x1p-24;
        }
    }
    fmt::print("  seed {}: {} rays and triangles, {} wrong hits, {} wrong misses\n", seed,
               with_commas(pairs), count.wrong_hits, count.wrong_misses);
    return count;
}

}  // namespace

TEST_CASE("Möller-Trumbore in double decides all random rays exactly") {
    const Decisions count = decisions(
        1, [](Pcg32& random, const Triangle&) { return random_point(random, -1.0f, 1.0f); });
    CHECK(count.wrong_hits == 0);
    CHECK(count.wrong_misses == 0);
    CHECK(count.beyond == 0);
}

TEST_CASE("Möller-Trumbore in double errs at edges and vertices only within its error bound") {
    const Decisions at_edges = decisions(
        2, [](Pcg32& random, const Triangle& t) { return t.a + random.uniform() * (t.b - t.a); });
    const Decisions at_vertices = decisions(3, [](Pcg32&, const Triangle& t) { return t.b; });
    CHECK(at_edges.beyond == 0);
    CHECK(at_vertices.beyond == 0);
    CHECK(at_vertices.wrong_misses >
          0);  // the bound is tried: rays whose exact answer rounding hides
}

TEST_CASE("the error bound is small: 10^-13 for triangles seen from the front") {
    const Triangle triangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    const Ray ray{.origin = {0.1f, 0.2f, 3}, .direction = {0.01f, -0.02f, -1}};
    const auto at = crossing(ray, triangle);
    const MollerTrumboreBound bound = moller_trumbore_bound(ray, triangle, *at);
    CHECK(bound.weight < 1e-13);
    CHECK(bound.t < 1e-13);
}

TEST_CASE(
    "Möller-Trumbore never hits a triangle without area, whatever rounding makes of its "
    "determinant") {
    Pcg32 random(4);
    std::size_t noisy = 0, hits = 0;
    for (int i = 0; i < pairs; ++i) {
        const auto fraction = [&] {
            return static_cast<float>(1 + random.below(1u << 20)) * 0x1p-23f;
        };
        const float sx = fraction(), sy = fraction(), sz = fraction(), ax = fraction(),
                    ay = fraction(), az = fraction();
        const Point3 a(ax, ay, az), step(sx, sy, sz);
        const Triangle triangle{a, a + step, a + 3.0f * step};
        REQUIRE(is_degenerate(triangle));
        const Point3 origin = i % 2 ? triangle.b : random_point(random, -1.0f, 1.0f);
        const Ray ray{
            .origin = origin, .direction = random_point(random, -1.0f, 1.0f), .tmin = -infinity};
        hits += MollerTrumbore::intersect(ray, triangle).has_value();
        const Double3 ab = Double3(triangle.b) - Double3(a), ac = Double3(triangle.c) - Double3(a);
        noisy += glm::dot(glm::cross(Double3(ray.direction), ac), ab) != 0.0;
    }
    CHECK(hits == 0);
    CHECK(noisy > pairs / 10u);  // the test tries what it says
}

namespace {

/// A multiple of 2^-10 in [-2, 2): sums of a few are exact, and coincidences are frequent.
rc::Gen<float> coordinate() {
    return rc::gen::map(rc::gen::inRange(-2048, 2048),
                        [](int i) { return static_cast<float>(i) * 0x1p-10f; });
}
rc::Gen<Point3> point() {
    return rc::gen::map(rc::gen::tuple(coordinate(), coordinate(), coordinate()),
                        [](const std::tuple<float, float, float>& p) {
                            return Point3(std::get<0>(p), std::get<1>(p), std::get<2>(p));
                        });
}
rc::Gen<Triangle> triangle() {
    return rc::gen::map(rc::gen::tuple(point(), point(), point()),
                        [](const std::tuple<Point3, Point3, Point3>& t) {
                            return Triangle{std::get<0>(t), std::get<1>(t), std::get<2>(t)};
                        });
}
/// Half of them aimed at a point of the triangle.
Ray ray_at(const Triangle& t) {
    const Point3 origin = *point();
    const float u = *coordinate() * 0.25f + 0.5f, v = *coordinate() * 0.25f + 0.5f;
    const Point3 target =
        *rc::gen::arbitrary<bool>() ? t.a + u * (t.b - t.a) + (1 - u) * v * (t.c - t.a) : *point();
    RC_PRE(target != origin);
    return {.origin = origin, .direction = target - origin};
}

}  // namespace

TEST_CASE("property: the hit's point lies on the triangle's plane, to within the rounding of t") {
    CHECK(rc::check([] {
        const Triangle t = *triangle();
        const Ray ray = ray_at(t);
        const std::optional<Hit> hit = MollerTrumbore::intersect(ray, t);
        if (!hit) return;
        const auto at = crossing(ray, t);
        RC_ASSERT(at.has_value());
        const Double3 p = Double3(ray.origin) + double{hit->t} * Double3(ray.direction);
        const double off = std::abs(glm::dot(normal(t), p - Double3(t.a)));
        const double bound = moller_trumbore_bound(ray, t, *at).t + 0x1p-24 * std::abs(at->t);
        const double evaluation =
            0x1p-48 * glm::length(normal(t)) * (glm::length(p) + glm::length(Double3(t.a)) + 1);
        RC_ASSERT(off <= bound * std::abs(at->determinant) + evaluation);
    }));
}

TEST_CASE("property: a direction 2^k times as long gives t exactly 2^-k times, and the same u, v") {
    CHECK(rc::check([] {
        const Triangle t = *triangle();
        const Ray ray = ray_at(t);
        const float scale = std::ldexp(1.0f, *rc::gen::inRange(-40, 41));
        const auto hit = MollerTrumbore::intersect(ray, t);
        const auto scaled = MollerTrumbore::intersect({ray.origin, ray.direction * scale}, t);
        RC_ASSERT(hit.has_value() == scaled.has_value());
        if (!hit) return;
        RC_ASSERT(scaled->t == hit->t / scale);
        RC_ASSERT(scaled->u == hit->u);
        RC_ASSERT(scaled->v == hit->v);
    }));
}

TEST_CASE("property: a scene 2^k times as large gives the same hit, bit for bit") {
    CHECK(rc::check([] {
        const Triangle t = *triangle();
        const Ray ray = ray_at(t);
        const float scale = std::ldexp(1.0f, *rc::gen::inRange(-60, 61));
        const Triangle large{t.a * scale, t.b * scale, t.c * scale};
        RC_ASSERT(MollerTrumbore::intersect(ray, t) ==
                  MollerTrumbore::intersect({ray.origin * scale, ray.direction * scale}, large));
    }));
}

TEST_CASE("property: a translation without rounding gives the same hit, bit for bit") {
    CHECK(rc::check([] {
        const Triangle t = *triangle();
        const Ray ray = ray_at(t);
        const auto whole = [] { return static_cast<float>(*rc::gen::inRange(-1024, 1025)); };
        const float x = whole(), y = whole(), z = whole();
        const Vector3 shift(x, y, z);
        const Triangle moved{t.a + shift, t.b + shift, t.c + shift};
        RC_ASSERT(MollerTrumbore::intersect(ray, t) ==
                  MollerTrumbore::intersect({ray.origin + shift, ray.direction}, moved));
    }));
}

TEST_CASE("property: the order of the vertices changes hit and miss only within the error bound") {
    CHECK(rc::check([] {
        const Triangle t = *triangle();
        const Ray ray = ray_at(t);
        const auto hit = MollerTrumbore::intersect(ray, t);
        for (const Triangle& other :
             {Triangle{t.b, t.c, t.a}, {t.c, t.a, t.b}, {t.a, t.c, t.b}, {t.b, t.a, t.c}}) {
            const auto again = MollerTrumbore::intersect(ray, other);
            if (hit.has_value() != again.has_value())
                RC_ASSERT(within_bound(ray, t) || within_bound(ray, other));
        }
    }));
}

TEST_CASE(
    "property: the order of the triangles changes the nearest triangle's index, never its t") {
    CHECK(rc::check([] {
        const auto triangles = *rc::gen::container<std::vector<Triangle>>(triangle());
        RC_PRE(!triangles.empty());
        const Ray ray = ray_at(triangles.front());
        std::vector<Triangle> shuffled = triangles;
        for (std::size_t i = shuffled.size(); i > 1; --i)
            std::swap(
                shuffled[i - 1],
                shuffled[static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(i)))]);
        const auto hit = closest_hit(Naive<>::build(triangles), ray),
                   again = closest_hit(Naive<>::build(shuffled), ray);
        RC_ASSERT(hit.has_value() == again.has_value());
        if (hit) {
            RC_ASSERT(hit->t == again->t);
            RC_ASSERT(triangles[hit->triangle] == shuffled[again->triangle] || hit->t == again->t);
        }
    }));
}

}  // namespace space
