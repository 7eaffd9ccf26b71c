// The suite over trees by the builders that do not only cut ranges from the root down.
#include "chapters/ch07_bounding_volume_hierarchies/bottom_up_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/optimised_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/over_bsp_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <span>
#include <string_view>

namespace space {
namespace {

template <TriangleTest Test>
using SpatialSplitBvh = Bvh<SpatialSplitBuilder, Test>;

template <class Builder>
void check_structure(std::string_view name, const typename Builder::Config& config = {}) {
    using A = Bvh<Builder>;
    check_accelerator<A>(
        name, [=](std::span<const Triangle> t) { return A::build(t, config); },
        SuiteOptions{}.fewer());
}

}  // namespace

TEST_CASE("the suite: spatial splits") {
    run_suite<SpatialSplitBvh>("bvh-spatial");
}

TEST_CASE("the suite: spatial splits wherever they may be") {
    check_structure<SpatialSplitBuilder>(
        "bvh-spatial, many",
        {.costs = {0.0, 1.0}, .max_leaf_size = 1, .min_overlap = 0.0, .max_growth = 4.0});
    check_structure<SpatialSplitBuilder>("bvh-spatial, all of them split",
                                         {.max_growth = 2.0, .unsplits = false});
}

TEST_CASE("the suite: morton, bottom-up, optimised, over BSP leaves") {
    check_structure<MortonBuilder>("bvh-morton");
    check_structure<BottomUpBuilder>("bvh-bottom-up");
    check_structure<OptimisedBuilder>("bvh-optimised", {.max_leaf_size = 2, .min_gain = 0.0});
    check_structure<OverBspBuilder>("bvh-over-bsp");
}

}  // namespace space
