#include "common/accelerator.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "tests/catch.hpp"

#include <type_traits>

namespace space {

static_assert(Accelerator<Naive<>>);
static_assert(!Accelerator<Triangle>);
static_assert(std::is_empty_v<NoCounts>, "not counting takes no memory");

TEST_CASE("the nearer hit has the smaller t, at equal t the smaller index") {
    CHECK(nearer({.t = 1, .triangle = 9}, {.t = 2, .triangle = 3}));
    CHECK_FALSE(nearer({.t = 2, .triangle = 3}, {.t = 1, .triangle = 9}));
    CHECK(nearer({.t = 1, .triangle = 3}, {.t = 1, .triangle = 9}));
    CHECK_FALSE(nearer({.t = 1, .triangle = 9}, {.t = 1, .triangle = 3}));
    CHECK_FALSE(nearer({.t = 1, .triangle = 3}, {.t = 1, .triangle = 3}));
}

TEST_CASE("counts count and add up") {
    TraversalCounts counts;
    counts.visit_node();
    counts.test_triangle();
    counts.test_triangle();
    TraversalCounts sum{.nodes_visited = 10, .triangles_tested = 20};
    sum += counts;
    CHECK(sum == TraversalCounts{.nodes_visited = 11, .triangles_tested = 22});
}

TEST_CASE(
    "naive tracing tests every triangle for the closest hit, and stops at the first for any hit") {
    const Triangle near{{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}},
        far{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}};
    const Naive<> naive = Naive<>::build(std::vector{far, near, near});
    const Ray ray{.origin = {0, 0, 0}, .direction = {0, 0, 1}};
    TraversalCounts closest, any;
    CHECK(naive.closest_hit(ray, closest) == Hit{.t = 1, .triangle = 1, .u = 0.25f, .v = 0.5f});
    CHECK(naive.any_hit(ray, any));
    CHECK(closest == TraversalCounts{.triangles_tested = 3});
    CHECK(any == TraversalCounts{.triangles_tested = 1});
    CHECK(naive.shape().references == 3);
    CHECK(naive.shape().bytes >= 3 * sizeof(Triangle));
    CHECK_FALSE(naive.shape().nodes);
}

}  // namespace space
