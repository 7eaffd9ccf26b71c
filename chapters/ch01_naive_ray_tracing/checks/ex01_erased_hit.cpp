#include "ex01_erased_hit.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <array>

using namespace space;

namespace {

Triangle at_depth(float z, float x = 0.0f) {
    return {{x - 1, -1, -z}, {x + 1, -1, -z}, {x, 1, -z}};
}
const Ray ahead{.origin = {0, 0, 0}, .direction = {0, 0, -1}};

}  // namespace

TEST_CASE("a later triangle that is missed erases nothing") {
    const std::array triangles{at_depth(3), at_depth(2, 10), at_depth(5, -10)};
    INFO("the ray hits triangle 0 at t = 3, and misses 1 and 2");
    const auto seen = what_the_ray_sees(triangles, ahead);
    REQUIRE(seen);
    CHECK(seen->t == 3.0f);
    CHECK(seen->triangle == 0);
}

TEST_CASE("the nearest hit wins, wherever it stands in the list") {
    const std::array triangles{at_depth(4), at_depth(2), at_depth(3)};
    INFO("the ray hits triangles 0, 1 and 2 at t = 4, 2 and 3");
    const auto seen = what_the_ray_sees(triangles, ahead);
    REQUIRE(seen);
    CHECK(seen->t == 2.0f);
    CHECK(seen->triangle == 1);
}

TEST_CASE("of two equal hits the smaller index wins") {
    const std::array triangles{at_depth(4), at_depth(2), at_depth(2)};
    INFO("the ray hits triangles 0, 1 and 2 at t = 4, 2 and 2");
    const auto seen = what_the_ray_sees(triangles, ahead);
    REQUIRE(seen);
    CHECK(seen->triangle == 1);
}

TEST_CASE("however far, near or close together the hits are, the nearest wins") {
    for (const float depth : {1e-20f, 1e-4f, 3.0f, 1e6f, 1e30f}) {
        const Triangle wide{{-1e35f, -1e35f, -depth}, {1e35f, -1e35f, -depth}, {0, 1e35f, -depth}};
        Triangle behind = wide;
        behind.a.z = behind.b.z = behind.c.z = std::nextafter(-depth, -infinity);
        CAPTURE(Number{depth});
        const auto seen = what_the_ray_sees(std::array{behind, wide, behind}, ahead);
        REQUIRE(seen);
        REQUIRE(Number{seen->t} == Number{depth});
        REQUIRE(seen->triangle == 1);
    }
}

TEST_CASE("a ray that meets nothing sees nothing") {
    CHECK_FALSE(what_the_ray_sees({}, ahead));
    const std::array triangles{at_depth(4, 10), at_depth(2, -10)};
    CHECK_FALSE(what_the_ray_sees(triangles, ahead));
}

TEST_CASE("2,000 random rays see what the naive tracer sees") {
    Pcg32 random(1);
    const auto point = [&] { return random_vector(random); };
    std::vector<Triangle> triangles;
    for (int i = 0; i < 50; ++i) triangles.push_back({point(), point(), point()});
    const Naive<> naive = Naive<>::build(triangles);
    for (int i = 0; i < 2'000; ++i) {
        const Ray ray{.origin = 2.0f * point(), .direction = point()};
        CAPTURE(ray);
        REQUIRE(what_the_ray_sees(triangles, ray) == closest_hit(naive, ray));
    }
}
