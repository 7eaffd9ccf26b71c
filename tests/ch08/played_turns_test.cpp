#include "chapters/ch08_parallel_builds/played_turns.hpp"

#include "tests/catch.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

using namespace space;

namespace {

BvhNodes<3> built(const std::vector<Triangle>& triangles, bool is_shared, std::uint64_t seed) {
    PlayedTurns turns(seed, 5);
    return SharedScratchBuilder<>::build<3>(triangles, {.is_shared = is_shared}, turns);
}
bool is_same(const BvhNodes<3>& a, const BvhNodes<3>& b) {
    return std::ranges::equal(a.nodes, b.nodes) && a.references == b.references;
}

}  // namespace

TEST_CASE("where each thread has its own scratch, all schedules give one tree and lose nothing") {
    const std::vector<Triangle> triangles = scenes::soup(200, 0.1f, 1);
    const BvhNodes<3> expected = built(triangles, false, 1);
    CHECK(lost_polygons<3>(expected, triangles).empty());
    for (std::uint64_t seed = 2; seed < std::uint64_t(sized(20, 6)); ++seed) {
        CAPTURE(seed);
        REQUIRE(is_same(built(triangles, false, seed), expected));
    }
}

TEST_CASE("a schedule gives the same tree again, also the wrong one") {
    const std::vector<Triangle> triangles = scenes::soup(200, 0.1f, 2);
    std::size_t losing = 0;
    for (std::uint64_t seed = 1; seed < 8; ++seed) {
        const BvhNodes<3> once = built(triangles, true, seed);
        CAPTURE(seed);
        REQUIRE(is_same(built(triangles, true, seed), once));
        losing += !lost_polygons<3>(once, triangles).empty();
    }
    CHECK(losing > 0);
}

TEST_CASE("no triangle is missing in the leaves: what is wrong is boxes") {
    const std::vector<Triangle> triangles = scenes::soup(200, 0.1f, 4);
    for (std::uint64_t seed = 1; seed < 5; ++seed) {
        std::vector<std::uint32_t> named = built(triangles, true, seed).references;
        std::ranges::sort(named);
        for (std::uint32_t i = 0; i < triangles.size(); ++i) REQUIRE(named.at(i) == i);
    }
}

TEST_CASE("a scene of one leaf is built without turns") {
    const std::vector<Triangle> triangles = scenes::soup(2, 0.1f, 5);
    CHECK(lost_polygons<3>(built(triangles, true, 1), triangles).empty());
}
