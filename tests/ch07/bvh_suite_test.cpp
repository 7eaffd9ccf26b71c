// The suite over trees of boxes by each of the builders, and by both ways to walk.
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/middle_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <span>
#include <string_view>

namespace space {
namespace {

template <TriangleTest Test = FilteredExact>
using BinnedBvh = Bvh<BinnedBuilder, Test>;

template <class A>
void check_suite(std::string_view name, const typename A::Config& config = {}) {
    check_accelerator<A>(
        name, [=](std::span<const Triangle> t) { return A::build(t, config); },
        SuiteOptions{}.fewer());
}

}  // namespace

TEST_CASE("the suite: binned") {
    run_suite<BinnedBvh>("bvh-binned");
}

TEST_CASE("the suite: sweep, median, middle") {
    check_suite<Bvh<SweepBuilder>>("bvh-sweep");
    check_suite<Bvh<MedianBuilder>>("bvh-median");
    check_suite<Bvh<MiddleBuilder>>("bvh-middle");
}

TEST_CASE("the suite: leaves of one triangle, and trees that depth ends") {
    check_suite<Bvh<BinnedBuilder>>("bvh-binned, leaves of one",
                                    {.costs = {0.0, 1.0}, .max_leaf_size = 1});
    check_suite<Bvh<BinnedBuilder>>("bvh-binned, shallow", {.max_depth = 2, .bins = 2});
}

TEST_CASE("the suite: every box that the ray meets, as it is often printed") {
    constexpr BvhWay printed{.order = BvhWay::Order::all_boxes};
    check_suite<Bvh<BinnedBuilder, FilteredExact, printed>>("bvh-binned, all boxes");
}

}  // namespace space
