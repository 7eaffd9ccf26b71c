// The suite over trees that have followed their triangles to where the suite has them.
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch09_instancing_and_motion/deforming.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace space {
namespace {

/// Built over the triangles at other places, and led to the right ones in four frames.
template <class A>
A led_back(std::span<const Triangle> triangles, const typename A::Config& config, bool rotates) {
    std::vector<Triangle> moved(triangles.begin(), triangles.end());
    const auto frame = [&](double time) { move_to(time, Scatter{3}, triangles, moved); };
    frame(0.5);
    A bvh = A::build(moved, config);
    for (const double time : {0.3, 0.2, 0.1}) {
        frame(time);
        rotates ? void(bvh.refit_and_rotate(moved)) : bvh.refit(moved);
    }
    bvh.refit(triangles);
    return bvh;
}

template <class A>
void check_suite(std::string_view name, bool rotates, const typename A::Config& config = {}) {
    check_accelerator<A>(
        name, [=](std::span<const Triangle> t) { return led_back<A>(t, config, rotates); },
        SuiteOptions{}.fewer());
}

}  // namespace

TEST_CASE("the suite: a tree that is refitted") {
    check_suite<RefittedBvh<>>("refitted", false);
    check_suite<RefittedBvh<SpatialSplitBuilder>>("refitted, spatial splits", false);
}

TEST_CASE("the suite: a tree with rotations") {
    check_suite<RefittedBvh<>>("rotated", true);
    check_suite<RefittedBvh<>>("rotated, leaves of one", true,
                               {.costs = {0.0, 1.0}, .max_leaf_size = 1});
}

}  // namespace space
