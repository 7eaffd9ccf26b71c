#include "tests/oracle/exact.hpp"

#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/integer_oracle.hpp"

#include <cmath>
#include <numbers>

namespace space {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
/// In the plane z = 0; its long edge is x + y = 4.
const Triangle corner{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

Ray down(float x, float y) {
    return {.origin = {x, y, 1}, .direction = {0, 0, -1}};
}

}  // namespace

TEST_CASE("the oracle tells interior, edges, vertices and misses apart by a single float") {
    CHECK(decide(down(1, 1), corner) == Place::interior);
    CHECK(decide(down(2, 2), corner) == Place::edge);
    CHECK(decide(down(1, 0), corner) == Place::edge);
    CHECK(decide(down(0, 1), corner) == Place::edge);
    CHECK(decide(down(0, 0), corner) == Place::vertex);
    CHECK(decide(down(4, 0), corner) == Place::vertex);
    CHECK(decide(down(0, 4), corner) == Place::vertex);
    CHECK(decide(down(2, std::nextafter(2.0f, 0.0f)), corner) == Place::interior);
    CHECK(decide(down(2, std::nextafter(2.0f, 3.0f)), corner) == Place::miss);
    CHECK(decide(down(1, 0x1p-149f), corner) == Place::interior);
    CHECK(decide(down(1, -0x1p-149f), corner) == Place::miss);
    CHECK(decide(down(0, std::nextafter(4.0f, 5.0f)), corner) == Place::miss);
}

TEST_CASE("the oracle decides alike from both sides and for every order of the vertices") {
    const auto& [a, b, c] = corner;
    for (const Triangle& triangle :
         {Triangle{a, b, c}, {b, c, a}, {c, a, b}, {a, c, b}, {c, b, a}, {b, a, c}}) {
        CHECK(decide(down(1, 2), triangle) == Place::interior);
        CHECK(decide(down(1, 3), triangle) == Place::edge);
        CHECK(decide({.origin = {1, 2, -1}, .direction = {0, 0, 1}}, triangle) == Place::interior);
        CHECK(decide({.origin = {1, 2, -1}, .direction = {0, 0, -1}}, triangle) == Place::miss);
    }
}

TEST_CASE("a triangle seen edge-on and a triangle without area are never hit") {
    CHECK(decide({.origin = {-1, 1, 0}, .direction = {1, 0, 0}}, corner) == Place::miss);
    CHECK(decide({.origin = {-1, 0, 0}, .direction = {1, 0, 0}}, corner) == Place::miss);
    CHECK(decide({.origin = {1, 1, 0}, .direction = {1, 1, 0}}, corner) == Place::miss);
    CHECK_FALSE(crossing({.origin = {-1, 1, 0}, .direction = {1, 0, 0}}, corner));

    const Triangle point{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    const Triangle segment{{-1, -1, 0}, {1, 1, 0}, {3, 3, 0}};
    CHECK(decide(down(0, 0), point) == Place::miss);
    CHECK(decide(down(0, 0), segment) == Place::miss);
    CHECK(is_degenerate(point));
    CHECK(is_degenerate(segment));
    CHECK(is_degenerate({{0, 0, 5}, {1, 1, 5}, {2, 2, 5}}));
    CHECK_FALSE(is_degenerate({{0, 0, 5}, {1, 1, 5}, {2, std::nextafter(2.0f, 3.0f), 5}}));
    CHECK_FALSE(is_degenerate({{1e20f, 0, 0}, {1e20f, 1e-20f, 0}, {1e20f, 0, 1e-20f}}));
    CHECK_FALSE(is_degenerate(corner));
}

TEST_CASE("an invalid ray hits nothing") {
    Ray ray = down(1, 1);
    REQUIRE(decide(ray, corner) == Place::interior);
    CHECK(decide({ray.origin, {0, 0, 0}}, corner) == Place::miss);
    CHECK(decide({ray.origin, {0, 0, nan}}, corner) == Place::miss);
    CHECK(decide({ray.origin, {0, 0, -infinity}}, corner) == Place::miss);
    CHECK(decide({{1, 1, nan}, ray.direction}, corner) == Place::miss);
    CHECK(decide({ray.origin, ray.direction, 2, 0}, corner) == Place::miss);
    CHECK(decide({ray.origin, ray.direction, nan, 2}, corner) == Place::miss);
    const ExactOracle oracle = ExactOracle::build({&corner, 1});
    CHECK(oracle.hits({ray.origin, ray.direction, 0, nan}).empty());
    CHECK(oracle.hits(ray).size() == 1);
}

TEST_CASE("the interval is closed, and compared with t after rounding to float") {
    const Ray ray = down(1, 1);
    CHECK(decide({ray.origin, ray.direction, 1, 1}, corner) == Place::interior);
    CHECK(decide({ray.origin, ray.direction, 0, std::nextafter(1.0f, 0.0f)}, corner) ==
          Place::miss);
    CHECK(decide({ray.origin, ray.direction, std::nextafter(1.0f, 2.0f), 2}, corner) ==
          Place::miss);
    CHECK(decide({ray.origin, ray.direction, -infinity, infinity}, corner) == Place::interior);

    // t = 1/3: the nearest float is a little more, and counts.
    const Ray third{.origin = {1, 1, 1}, .direction = {0, 0, -3}};
    const float t = 1.0f / 3.0f;
    REQUIRE(double{t} > 1.0 / 3.0);
    CHECK(decide({third.origin, third.direction, t, t}, corner) == Place::interior);
    CHECK(decide({third.origin, third.direction, 0, std::nextafter(t, 0.0f)}, corner) ==
          Place::miss);
}

TEST_CASE("t is the nearest float, ties to even, from the smallest to beyond the largest") {
    const auto t = [](float from, float plane, float speed) {
        const Triangle wide{{-1, -1, plane}, {4, -1, plane}, {-1, 4, plane}};
        const auto hits = ExactOracle::build({&wide, 1})
                              .hits({.origin = {0, 0, from}, .direction = {0, 0, speed}});
        REQUIRE(hits.size() == 1);
        return hits.front().t;
    };
    CHECK(t(0, 1, 3) == 1.0f / 3.0f);
    CHECK(t(-1, 0x1p24f, 1) == 0x1p24f);           // 2^24 + 1: between two floats
    CHECK(t(-3, 0x1p24f, 1) == 0x1p24f + 4.0f);    // 2^24 + 3
    CHECK(t(0, 0x1p-50f, 0x1p100f) == 0.0f);       // half of the smallest float
    CHECK(t(0, 0x3p-50f, 0x1p100f) == 0x1p-148f);  // one and a half
    CHECK(t(0, 0x1.000002p-50f, 0x1p100f) == 0x1p-149f);
    CHECK(t(-3e38f, 3e38f, 1) == infinity);
    CHECK(t(0, 0x1.fffffep127f, 1) == 0x1.fffffep127f);
    CHECK(t(-0x1p102f, 0x1.fffffep127f, 1) ==
          0x1.fffffep127f);  // less than half a unit beyond the largest
    CHECK(t(-0x1p103f, 0x1.fffffep127f, 1) == infinity);  // half a unit: to even
}

TEST_CASE("hits come in the order of exact t, with equal ranks at equal t only") {
    const auto layer = [](float z) { return Triangle{{-4, -4, z}, {8, -4, z}, {-4, 8, z}}; };
    const float z = 1.0f / 3.0f;
    const std::vector<Triangle> layers{layer(0), layer(z), layer(std::nextafter(z, 1.0f)), layer(z),
                                       layer(-1)};
    const ExactOracle oracle = ExactOracle::build(layers);

    // So far away that the floats of t are the same for the layers a float apart.
    const auto hits = oracle.hits({.origin = {0.1f, 0.2f, 1e6f}, .direction = {0, 0, -1}});
    REQUIRE(hits.size() == 5);
    const std::uint32_t triangles[] = {2, 1, 3, 0, 4}, ranks[] = {0, 1, 1, 2, 3};
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(hits[i].triangle == triangles[i]);
        CHECK(hits[i].rank == ranks[i]);
    }
    CHECK(hits[0].t == hits[1].t);

    CHECK(oracle.closest({.origin = {0, 0, -3}, .direction = {0, 0, 1}}).size() == 1);
    const auto tied = oracle.closest({.origin = {0, 0, 0.1f}, .direction = {0, 0, 1}});
    REQUIRE(tied.size() == 2);
    CHECK(tied[0].triangle == 1);
    CHECK(tied[1].triangle == 3);
    CHECK(oracle.closest({.origin = {0, 0, 2}, .direction = {0, 0, 1}}).empty());
    CHECK(ExactOracle::build({}).hits(down(0, 0)).empty());
}

TEST_CASE(
    "the oracle sees a vertex and an edge where floats do not: no ray leaks between neighbours") {
    // Two triangles that share the edge a c, and a ray that meets that edge only to within
    // rounding.
    const Point3 a(-1.0625f, -1.125f, -0.125f), b(0.75f, -0.875f, 0.0625f), c(1.1875f, 1.0625f, 0),
        d(-1.0625f, 0.8125f, -0.125f);
    const std::vector<Triangle> quad{{a, b, c}, {a, c, d}};
    CHECK(ExactOracle::build(quad).hits({{3, 2, 5}, {-2.26249981f, -1.375f, -5.0250001f}}).size() ==
          1);

    // A fan of six: every ray near the hub hits one of them, and all where it passes the hub
    // exactly. The coordinates have so many bits that double would round, and so few that the
    // directions to the hub are exact.
    const auto exact = [](const Point3& p) { return glm::round(p * 0x1p20f) * 0x1p-20f; };
    const Point3 hub = exact({0.1f, 0.2f, 0.3f});
    std::vector<Triangle> fan;
    const auto rim = [&](int k) {
        const double angle = k % 6 * std::numbers::pi / 3;
        return hub + Point3(static_cast<float>(std::cos(angle)),
                            static_cast<float>(std::sin(angle)), 0.0f);
    };
    for (int k = 0; k < 6; ++k) fan.push_back({hub, rim(k), rim(k + 1)});
    const ExactOracle oracle = ExactOracle::build(fan);
    Pcg32 random(17);
    for (int i = 0; i < 1000; ++i) {
        const Point3 origin = exact(random_point(random, 1.0f, 7.0f));
        const auto at_hub = oracle.hits({origin, hub - origin});
        CHECK(at_hub.size() == 6);
        CHECK(at_hub.front().place == Place::vertex);
        CHECK(at_hub.back().rank == 0);
        const Vector3 beside = hub - origin + random_point(random, -1e-6f, 1e-6f);
        CHECK(!oracle.hits({origin, beside}).empty());
    }
}

TEST_CASE("the exact oracle and whole-number arithmetic agree on every hit, place and order") {
    std::size_t hits = 0, borders = 0, ties = 0;
    for (const std::uint32_t range : {3u, 40u, 8192u}) {
        Pcg32 random(range);
        const auto coordinate = [&] {
            return static_cast<float>(random.below(2 * range + 1)) - static_cast<float>(range);
        };
        const auto point = [&] {
            const float x = coordinate(), y = coordinate(), z = coordinate();
            return Point3(x, y, z);
        };
        std::vector<Triangle> triangles;
        for (int i = 0; i < 60; ++i) {
            const Point3 a = point(), b = point();
            triangles.push_back({a, b, point()});
        }
        const ExactOracle exact = ExactOracle::build(triangles);
        const IntegerOracle whole = IntegerOracle::build(triangles);
        for (int i = 0; i < 600; ++i) {
            const Point3 origin = i % 7 ? point() : triangles[random.below(60)].a;
            const Point3 target = i % 3 ? point() : triangles[random.below(60)].b;
            const Ray ray{origin, i % 5 ? target - origin : point()};
            if (!is_valid(ray)) continue;
            const auto left = exact.hits(ray), right = whole.hits(ray);
            REQUIRE(left.size() == right.size());
            for (std::size_t k = 0; k < left.size(); ++k) {
                CHECK(left[k].triangle == right[k].triangle);
                CHECK(left[k].place == right[k].place);
                CHECK(left[k].rank == right[k].rank);
                CHECK(left[k].t == right[k].t);
                CHECK(decide(ray, triangles[left[k].triangle]) == left[k].place);
                ++hits;
                borders += left[k].place != Place::interior;
                ties += k > 0 && left[k].rank == left[k - 1].rank;
            }
        }
    }
    CHECK(hits > 2000);
    CHECK(borders > 500);
    CHECK(ties > 200);
}

TEST_CASE(
    "the exact oracle and CGAL's own predicate agree on rays at and beside edges and vertices") {
    Pcg32 random(18);
    std::size_t compared = 0, hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const float scale = std::ldexp(1.0f, static_cast<int>(random.below(41)) - 20);
        const auto point = [&] { return random_point(random, -1.0f, 1.0f) * scale; };
        const Point3 a = point(), b = point(), c = point();
        const Triangle triangle{a, b, c};
        const Point3 origin = i % 6 == 0 ? a : i % 6 == 1 ? (a + b) * 0.5f : point();
        const float s = random.uniform();
        const Point3 target = i % 4 == 0   ? b
                              : i % 4 == 1 ? b + s * (c - b)
                              : i % 4 == 2 ? a + s * (c - a)
                                           : point();
        const Ray ray{origin, target - origin};
        if (!is_valid(ray) || is_degenerate(triangle) || !crossing(ray, triangle)) continue;
        const bool hit = decide(ray, triangle) != Place::miss;
        // CGAL's ray starts at exactly t = 0, ours half a float before it.
        if (crossing(ray, triangle)->t < 0 && hit) continue;
        CHECK(hit == cgal_do_intersect(ray, triangle));
        ++compared;
        hits += hit;
    }
    CHECK(compared > 2500);
    CHECK(hits > 500);
}

TEST_CASE("the crossing's weights sum to one and give back the point") {
    const std::optional<Crossing> at = crossing(down(1, 2), corner);
    REQUIRE(at);
    CHECK(at->t == 1.0);
    CHECK(at->u == 0.25);
    CHECK(at->v == 0.5);
    CHECK(at->w == 0.25);
    CHECK(at->determinant == -16.0);
    const std::optional<Crossing> outside = crossing(down(-1, 2), corner);
    REQUIRE(outside);
    CHECK(outside->u == -0.25);
    CHECK(outside->w == 0.75);
}

}  // namespace space
