// What is true of all wide trees, whatever the triangles: properties, on random examples that
// shrink.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "common/accelerator.hpp"
#include "tests/catch.hpp"
#include "tests/ch10/every_kernel.hpp"
#include "tests/ch10/wide_faults.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace space {
namespace {

/// The same examples on every run; RC_PARAMS in the environment asks for others.
const int seeded =
    ::setenv("RC_PARAMS", is_sanitized ? "seed=1 max_success=30" : "seed=1 max_success=300", 0);

/// Coordinates that often tie, some of them as large or as small as floats get; at times no
/// numbers.
Point3 some_point() {
    static constexpr float odd[] = {1e30f, -3e38f, 1e-42f, -0.0f, 1e-20f, 0x1p30f, infinity};
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) {
        const int kind = *rc::gen::inRange(0, 90);
        p[axis] = kind < 7 ? odd[kind] : float(*rc::gen::inRange(0, 9));
    }
    return p;
}
/// The same without what kernels leave to the plain walk.
Point3 some_modest_point() {
    static constexpr float odd[] = {1e-42f, -0.0f, 1e-20f, 0x1p29f, -1e-3f};
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) {
        const int kind = *rc::gen::inRange(0, 60);
        p[axis] = kind < 5 ? odd[kind] : float(*rc::gen::inRange(0, 9));
    }
    return p;
}
template <class SomePoint>
std::vector<Triangle> some_triangles(const SomePoint& point) {
    std::vector<Triangle> triangles(*rc::gen::inRange<std::size_t>(0, 60));
    for (Triangle& t : triangles) {
        t.a = point();
        t.b = point();
        t.c = point();
    }
    return triangles;
}
template <class SomePoint>
std::vector<Ray> some_rays(const SomePoint& point) {
    std::vector<Ray> rays(8);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].origin = point();
        const Point3 target = point();
        rays[i].direction = target - rays[i].origin;
        if (i % 5 == 4) rays[i].tmin = -infinity;
        if (i % 4 == 3) rays[i].tmax = 1.0f;
        if (i % 8 == 6) rays[i].direction *= 0x1p-80f;
    }
    return rays;
}

std::string text(const Point3& p) {
    return fmt::format("({}, {}, {})", p.x, p.y, p.z);
}
std::string text(const std::optional<Hit>& hit) {
    return hit ? fmt::format("{} at {}", hit->triangle, hit->t) : "no hit";
}

template <class SomePoint>
void check_property(const SomePoint& point) {
    const auto triangles = some_triangles(point);
    const auto rays = some_rays(point);
    const auto naive = Naive<FilteredExact>::build(triangles);
    std::vector<std::optional<Hit>> expected;
    for (const Ray& ray : rays) expected.push_back(closest_hit(naive, ray));
    const auto leaf = *rc::gen::inRange<std::size_t>(1, 10);
    const auto way =
        *rc::gen::element(CollapseConfig::Way::least_cost, CollapseConfig::Way::greedy);
    const auto node_cost = double(*rc::gen::inRange(0, 4));
    const CollapseConfig collapse{.way = way, .node_cost = node_cost, .max_leaf = leaf};
    const auto check = [&](const auto& bvh, const std::string& name, Named how = Named::once) {
        RC_ASSERT(wide_faults(bvh.tree(), triangles, how) == "");
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (const auto got = closest_hit(bvh, rays[i]); got != expected[i]) {
                for (const Triangle& t : triangles) RC_LOG() << text(t.a) << text(t.b) << text(t.c);
                RC_LOG() << name << ": " << text(rays[i].origin) << text(rays[i].direction)
                         << rays[i].tmin << " to " << rays[i].tmax;
                RC_FAIL("got " + text(got) + ", should be " + text(expected[i]));
            }
            RC_ASSERT(any_hit(bvh, rays[i]) == expected[i].has_value());
        }
    };
    for_each_kernel<QuickBuilder>(triangles, check,
                                  {.binary = {.max_leaf_size = leaf}, .collapse = collapse});
    check(WideBvh<8, BinnedBuilder>::build(triangles, {.collapse = collapse}), "binned");
    check(WideBvh<4, SpatialSplitBuilder>::build(
              triangles, {.binary = {.min_overlap = 0.0, .max_growth = 2.0}, .collapse = collapse}),
          "spatial splits", Named::in_parts);
    check(FastHighBvh<>::build(triangles, {.collapse = collapse}), "high quality", Named::in_parts);
}

}  // namespace

TEST_CASE("property: whatever the triangles, a whole wide tree, and the naive loop's answers") {
    CHECK(rc::check([] { check_property(some_point); }));
}

TEST_CASE("property: the same where the kernels answer") {
    CHECK(rc::check([] { check_property(some_modest_point); }));
}

}  // namespace space
