// What the plain ray-triangle tests lose, and the cures keep. Filtered exact is the truth here.
#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "tests/catch.hpp"

#include <numbers>

namespace space::ch02 {
namespace {

constexpr std::uint64_t leak_rays = 10'000, bounce_count = 10'000;
constexpr int pairs_each = 50'000;

template <class Test>
std::size_t index_of() {
    std::size_t found = triangle_test_count;
    for_each_named(triangle_tests, [&](std::size_t i, const auto& named) {
        if (std::is_same_v<TestOf<decltype(named)>, Test>) found = i;
    });
    return found;
}

template <class Test>
int hits(const Ray& ray, std::span<const Triangle> triangles) {
    int count = 0;
    for (const Triangle& triangle : triangles) count += Test::intersect(ray, triangle).has_value();
    return count;
}

/// T1: two triangles with the edge ac, and a ray at it.
const Triangle quad[] = {
    {{-1.0625f, -1.125f, -0.125f}, {0.75f, -0.875f, 0.0625f}, {1.1875f, 1.0625f, 0.0f}},
    {{-1.0625f, -1.125f, -0.125f}, {1.1875f, 1.0625f, 0.0f}, {-1.0625f, 0.8125f, -0.125f}}};
const Ray at_edge{{3, 2, 5}, {-2.26249981f, -1.375f, -5.0250001f}};

std::vector<Triangle> fan() {
    const Point3 hub(0.1f, 0.2f, 0.3f);
    const auto rim = [&](int k) {
        const double angle = k * std::numbers::pi / 3.0;
        return Point3(static_cast<float>(0.1f + std::cos(angle)),
                      static_cast<float>(0.2f + std::sin(angle)), 0.3f);
    };
    std::vector<Triangle> triangles;
    for (int k = 0; k < 6; ++k)  // with the hub in each place of the vertex order
        triangles.push_back(k % 3 == 0   ? Triangle{hub, rim(k), rim((k + 1) % 6)}
                            : k % 3 == 1 ? Triangle{rim((k + 1) % 6), hub, rim(k)}
                                         : Triangle{rim(k), rim((k + 1) % 6), hub});
    return triangles;
}

}  // namespace

TEST_CASE(
    "at a shared edge Möller-Trumbore in float hits neither triangle, the watertight and the exact "
    "tests one") {
    CHECK(hits<MollerTrumboreFloat>(at_edge, quad) == 0);
    CHECK(hits<Watertight>(at_edge, quad) == 1);
    CHECK(hits<Plucker>(at_edge, quad) == 1);
    CHECK(hits<FilteredExact>(at_edge, quad) == 1);
    CHECK(FilteredExact::intersect(at_edge, quad[0]));
}

TEST_CASE(
    "at a shared vertex plain tests lose rays between six triangles, the watertight and the exact "
    "ones none") {
    const std::vector<Triangle> triangles = fan();
    Pcg32 random(608);
    int plain = 0, watertight = 0, exact = 0, edges = 0;
    for (int i = 0; i < pairs_each; ++i) {
        const Point3 origin = Point3(0, 0, 7) + 4.0f * random_vector(random);
        // Not -s, which would let too much cancel: rounded once more.
        const Ray ray{origin, random.uniform(0.5f, 1.5f) * (triangles[0].a - origin)};
        plain += hits<MollerTrumboreFloat>(ray, triangles) == 0;
        edges += hits<LichterFirst>(ray, triangles) == 0;
        watertight += hits<Watertight>(ray, triangles) == 0;
        exact += hits<FilteredExact>(ray, triangles) == 0;
    }
    CHECK(plain > pairs_each / 1000);
    CHECK(edges > plain);
    CHECK(watertight == 0);
    CHECK(exact == 0);
}

TEST_CASE("an absolute epsilon misses small triangles, the sign of the determinant does not") {
    for (const float s : {0.0005f, 1e-5f, 1e-12f, 1e-18f}) {
        const Triangle small{{0, 0, 0}, {s, 0, 0}, {0, s, 0}};
        const Ray ray{{s / 4, s / 4, 1}, {0, 0, -1}};
        INFO("edges of length " << s);
        CHECK_FALSE(LichterFirst::intersect(ray, small));
        CHECK_FALSE(LichterImproved::intersect(ray, small));
        for (const std::optional<Hit>& hit :
             {MollerTrumbore::intersect(ray, small), MollerTrumboreFloat::intersect(ray, small),
              Watertight::intersect(ray, small), FilteredExact::intersect(ray, small)}) {
            REQUIRE(hit);
            CHECK(hit->t == 1.0f);
        }
    }
}

TEST_CASE(
    "the watertight test's second look tells the signs of edge functions that round to zero") {
    for (const float s : {1e-20f, 1e-24f, 1e-30f}) {
        const Triangle small{{0, 0, 0}, {s, 0, 0}, {0, s, 0}};
        const Ray ray{{s / 4, s / 4, 1}, {0, 0, -1}};
        const auto hit = Watertight::intersect(ray, small);
        if (s > 1e-22f) {  // in double the determinant is a float still
            REQUIRE(hit);
            CHECK(hit->t == 1.0f);
        }
        CHECK_FALSE(Watertight::intersect({{-s, s / 4, 1}, {0, 0, -1}}, small));
    }
    // Two rounded products that are equal are told apart: the ray passes beside the edge bc.
    constexpr float bit = 0x1p-23f;
    const Triangle beside{{-1, 1, 0}, {1 + bit, 1, 0}, {-1, -1 + bit, 0}};
    CHECK_FALSE(FilteredExact::intersect({{0, 0, 1}, {0, 0, -1}}, beside));
    CHECK_FALSE(Watertight::intersect({{0, 0, 1}, {0, 0, -1}}, beside));
}

TEST_CASE(
    "whatever overflows, u and v of a hit are finite, and t in all but Möller & Trumbore's and the "
    "exact test") {
    Pcg32 random(609);
    int hits = 0;
    for (const float scale : {1e10f, 1e13f, 1e19f, 1e30f, 3e37f})
        for (const float length : {1.0f, 1e13f, 1e30f, 3e38f})
            for (int i = 0; i < pairs_each / 100; ++i) {
                const Triangle triangle{scale * random_vector(random),
                                        scale * random_vector(random),
                                        scale * random_vector(random)};
                Ray ray{.origin = scale * random_vector(random),
                        .direction = length * random_vector(random)};
                if (i % 2) ray.direction = length * Vector3(random_direction(random));
                for_each_named(triangle_tests, [&](std::size_t, const auto& named) {
                    using Test = TestOf<decltype(named)>;
                    const auto hit = Test::intersect(ray, triangle);
                    if (!hit) return;
                    ++hits;
                    INFO(named.name << ": " << hit->t << " " << hit->u << " " << hit->v);
                    REQUIRE(std::isfinite(hit->u));
                    REQUIRE(std::isfinite(hit->v));
                    if (std::isinf(hit->t))  // rightly so in double: the exact t is beyond floats
                        REQUIRE((std::is_same_v<Test, MollerTrumbore> ||
                                 std::is_same_v<Test, MollerTrumboreFloat> ||
                                 std::is_same_v<Test, FilteredExact>));
                });
            }
    CHECK(hits > 1'000);
}

TEST_CASE(
    "no ray leaks through a closed mesh with the watertight or the exact test; with Plücker's at "
    "most a fifth as "
    "many do as with any plain one in float") {
    for (const int shift : {0, 3}) {
        const Leaks leaks = closed_mesh_leaks(2, shift, leak_rays, 601, 2);
        INFO(leaks.mesh);
        CHECK(leaks.rays == leak_rays);
        CHECK(leaks.leaks[index_of<Watertight>()] == 0);
        CHECK(leaks.leaks[index_of<FilteredExact>()] == 0);
        for (const std::size_t plain : {index_of<MollerTrumboreFloat>(), index_of<LichterFirst>(),
                                        index_of<LichterImproved>(), index_of<UnitTriangle>()}) {
            CHECK(leaks.leaks[plain] > 0);
            CHECK(5 * leaks.leaks[index_of<Plucker>()] <= leaks.leaks[plain]);
        }
    }
}

TEST_CASE(
    "signed volumes and watertight edge functions see a shared edge alike from both its triangles: "
    "a ray beside both "
    "is beside none") {
    // Two triangles on an edge pq, r and s on either side of it in the plane through pq that faces
    // the ray: a ray that crosses the edge's line between p and q hits at least one of them,
    // whatever rounding says of the side.
    Pcg32 random(602);
    int watertight_leaks = 0, plucker_leaks = 0, plain_leaks = 0;
    for (int i = 0; i < pairs_each; ++i) {
        const auto about = [&](float x, float y) {
            return Point3(x, y, 0.0f) + 0.25f * random_vector(random);
        };
        const Point3 p = about(-1, -1), q = about(1, 1), r = about(1, -1), s = about(-1, 1);
        const Triangle pair[] = {{p, r, q}, {p, q, s}};
        const Point3 origin = Point3(0, 0, 5) + 2.0f * random_vector(random);
        const Double3 target =
            Double3(p) + (0.05 + 0.9 * random.uniform_double()) * (Double3(q) - Double3(p));
        const Ray ray{origin, Point3(target) - origin};
        watertight_leaks += hits<Watertight>(ray, pair) == 0;
        plucker_leaks += hits<Plucker>(ray, pair) == 0;
        plain_leaks += hits<MollerTrumboreFloat>(ray, pair) == 0;
    }
    CHECK(watertight_leaks == 0);
    CHECK(plucker_leaks == 0);
    CHECK(plain_leaks > pairs_each / 50);
}

TEST_CASE(
    "the order of a triangle's vertices does not matter to Plücker's, the watertight and the exact "
    "decision") {
    Pcg32 random(603);
    int different = 0;
    for (int i = 0; i < pairs_each; ++i) {
        const auto [ray, triangle] = make_pair({"", i % 2 ? Aim::edge : Aim::vertex}, random);
        const auto& [a, b, c] = triangle;
        for (const Triangle& turned : {Triangle{b, c, a}, Triangle{c, a, b}, Triangle{a, c, b},
                                       Triangle{c, b, a}, Triangle{b, a, c}}) {
            // Only the decision about the line: t is rounded in another order.
            const Ray line{ray.origin, ray.direction, -infinity, infinity};
            different += Watertight::intersect(line, triangle).has_value() !=
                         Watertight::intersect(line, turned).has_value();
            different += FilteredExact::intersect(line, triangle).has_value() !=
                         FilteredExact::intersect(line, turned).has_value();
            different += Plucker::intersect(line, triangle).has_value() !=
                         Plucker::intersect(line, turned).has_value();
        }
    }
    CHECK(different == 0);
}

TEST_CASE(
    "all tests agree on rays clearly inside or outside, and t, u and v are near the exact ones") {
    Pcg32 random(604);
    int inside = 0, outside = 0;
    for (int i = 0; i < pairs_each / 10; ++i) {
        const auto [ray, triangle] = make_pair(triangle_inputs()[0], random);
        // A whole number of triangle sizes: seen at more than a few degrees and not thin.
        const Double3 n = normal(triangle);
        if (glm::length(n) < 0.5 ||
            std::abs(glm::dot(glm::normalize(n), glm::normalize(Double3(ray.direction)))) < 0.1)
            continue;
        const auto middle = (triangle.a + triangle.b + triangle.c) / 3.0f;
        const auto resized = [&](float factor) {
            return Triangle{middle + factor * (triangle.a - middle),
                            middle + factor * (triangle.b - middle),
                            middle + factor * (triangle.c - middle)};
        };
        const bool smaller = FilteredExact::intersect(ray, resized(0.999f)).has_value(),
                   larger = FilteredExact::intersect(ray, resized(1.001f)).has_value();
        if (smaller != larger) continue;
        const auto exact = FilteredExact::intersect(ray, triangle);
        REQUIRE(exact.has_value() == larger);
        (larger ? inside : outside) += 1;
        for_each_named(triangle_tests, [&](std::size_t, const auto& named) {
            const auto hit = TestOf<decltype(named)>::intersect(ray, triangle);
            INFO(named.name);
            REQUIRE(hit.has_value() == larger);
            if (!hit) return;
            CHECK(std::abs(hit->t - exact->t) <= 1e-4f * exact->t);
            CHECK(std::abs(hit->u - exact->u) <= 1e-3f);
            CHECK(std::abs(hit->v - exact->v) <= 1e-3f);
        });
    }
    CHECK(inside > pairs_each / 1000);
    CHECK(outside > pairs_each / 1000);
}

TEST_CASE(
    "an offset origin neither hits its triangle again nor leaks, near and far from the world's "
    "origin; without it "
    "three in four hit it again") {
    const OriginWay &plain = origin_ways().front(), &offset = origin_ways().back();
    for (const double place : {0.0, 1e3, 1e5}) {
        INFO("room at " << place);
        const Bounces none =
            bounces(plain, index_of<FilteredExact>(), place, bounce_count / 10, 605, 2);
        CHECK(4 * none.self_hits > 3 * none.bounces);
        CHECK(none.bounces == bounce_count / 10);
        const Bounces moved =
            bounces(offset, index_of<FilteredExact>(), place, bounce_count, 605, 2);
        CHECK(moved.bounces == bounce_count);
        CHECK(moved.self_hits == 0);
        CHECK(moved.leaks == 0);
    }
}

TEST_CASE("no leak over 10^6 bounces and 10^6 rays: the full sizes", "[.big]") {
    for (const double place : {0.0, 1e3, 1e5}) {
        const Bounces moved =
            bounces(origin_ways().back(), index_of<FilteredExact>(), place, 1'000'000, 606, 2);
        CHECK(moved.self_hits == 0);
        CHECK(moved.leaks == 0);
    }
    const Leaks leaks = closed_mesh_leaks(3, 0, 1'000'000, 607, 2);
    CHECK(leaks.leaks[index_of<Watertight>()] == 0);
    CHECK(leaks.leaks[index_of<FilteredExact>()] == 0);
}

}  // namespace space::ch02
