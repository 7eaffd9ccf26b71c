/// @file
/// Chapter 7's structures: one tree of boxes by every builder.
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bottom_up_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/middle_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/optimised_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/over_bsp_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"

namespace space {
namespace {

template <TriangleTest Test>
using BinnedBvh = Bvh<BinnedBuilder, Test>;
template <TriangleTest Test>
using SweepBvh = Bvh<SweepBuilder, Test>;
template <TriangleTest Test>
using MiddleBvh = Bvh<MiddleBuilder, Test>;
template <TriangleTest Test>
using MedianBvh = Bvh<MedianBuilder, Test>;
template <TriangleTest Test>
using SpatialSplitBvh = Bvh<SpatialSplitBuilder, Test>;
template <TriangleTest Test>
using OptimisedBvh = Bvh<OptimisedBuilder, Test>;
template <TriangleTest Test>
using BottomUpBvh = Bvh<BottomUpBuilder, Test>;
template <TriangleTest Test>
using MortonBvh = Bvh<MortonBuilder, Test>;
template <TriangleTest Test>
using OverBspBvh = Bvh<OverBspBuilder, Test>;

}  // namespace

std::vector<Structure> ch07_structures() {
    return {
        offer<BinnedBvh>("bvh-binned", "BVH by the surface area heuristic, over bins (chapter 7)"),
        offer<SweepBvh>("bvh-sweep", "the same; over all cuts"),
        offer<SpatialSplitBvh>("bvh-spatial",
                               "the same; planes may cut triangles, named on both sides"),
        offer<OptimisedBvh>("bvh-optimised",
                            "bvh-binned, its subtrees put back where they cost least"),
        offer<BottomUpBvh>("bvh-bottom-up", "BVH from the leaves up; nearest neighbours first"),
        offer<MortonBvh>("bvh-morton", "linear BVH: cut where Morton codes' highest bits change"),
        offer<OverBspBvh>("bvh-over-bsp", "boxes around chapter 3's BSP tree",
                          [](OverBspBuilder::Config& config, const Limits& limits) {
                              config.bsp.max_fragments = limits.references;
                              config.bsp.max_placed = limits.placements;
                          }),
        offer<MiddleBvh>("bvh-middle", "BVH; the longest axis cut in the middle"),
        offer<MedianBvh>("bvh-median", "BVH; the longest axis halved by count"),
    };
}

}  // namespace space
