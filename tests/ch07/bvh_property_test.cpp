// What is true of all trees of boxes: properties, on random examples that shrink.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/bvh_trees.hpp"

#include <rapidcheck.h>

#include <cstdlib>
#include <vector>

namespace space {
namespace {

/// The same examples on every run; RC_PARAMS in the environment asks for others.
const int seeded = ::setenv("RC_PARAMS", "seed=1 max_success=300", 0);

/// Coordinates that often tie, some of them as large or as small as floats get.
Point3 some_point() {
    static constexpr float odd[] = {1e30f, -3e38f, 1e-42f, -0.0f, 1e-20f};
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) {
        const int kind = *rc::gen::inRange(0, 60);
        p[axis] = kind < 5 ? odd[kind] : float(*rc::gen::inRange(0, 9));
    }
    return p;
}
std::vector<Triangle> some_triangles() {
    std::vector<Triangle> triangles(*rc::gen::inRange<std::size_t>(0, 40));
    for (Triangle& t : triangles) t = {some_point(), some_point(), some_point()};
    return triangles;
}

template <class Builder>
void check_property(const std::vector<Triangle>& triangles,
                    const typename Builder::Config& config) {
    const auto bvh = Bvh<Builder>::build(triangles, config);
    RC_ASSERT(faults_of(bvh.nodes(), triangles, std::max<std::size_t>(config.max_leaf_size, 1)) ==
              "");
    const auto naive = Naive<FilteredExact>::build(triangles);
    for (int i = 0; i < 8; ++i) {
        Ray ray{.origin = some_point(), .direction = some_point() - some_point()};
        if (i % 3 == 0) ray.tmin = -infinity;
        if (i % 4 == 0) ray.tmax = 1.0f;
        const auto expected = closest_hit(naive, ray);
        RC_ASSERT(closest_hit(bvh, ray) == expected);
        RC_ASSERT(any_hit(bvh, ray) == expected.has_value());
    }
}

}  // namespace

TEST_CASE(
    "property: whatever the triangles and limits, a whole tree, and the naive loop's answers") {
    CHECK(rc::check([] {
        const auto triangles = some_triangles();
        const auto leaf = *rc::gen::inRange<std::size_t>(0, 6);
        const auto depth = *rc::gen::inRange(0u, 12u);
        const BvhCosts costs{double(*rc::gen::inRange(0, 4)), 1.0};
        check_property<MedianBuilder>(triangles, {costs, leaf});
        check_property<MiddleBuilder>(triangles, {costs, leaf, depth});
        check_property<SweepBuilder>(triangles, {costs, leaf, depth});
        check_property<BinnedBuilder>(triangles, {costs, leaf, depth, leaf * 7});
    }));
}

}  // namespace space
