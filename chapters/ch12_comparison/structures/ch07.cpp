/// @file
/// Chapter 7's structures: one tree of boxes by every builder.
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bottom_up_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/middle_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/optimised_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/over_bsp_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "chapters/ch12_comparison/structures/offer_bvh.hpp"

namespace space {

std::vector<Structure> ch07_structures() {
    return {
        offer_bvh<BinnedBuilder>("bvh-binned",
                                 "BVH by the surface area heuristic, over bins (chapter 7)"),
        offer_bvh<SweepBuilder>("bvh-sweep", "the same; over all cuts"),
        offer_bvh<SpatialSplitBuilder>("bvh-spatial",
                                       "the same; planes may cut triangles, named on both sides"),
        offer_bvh<OptimisedBuilder>("bvh-optimised",
                                    "bvh-binned, its subtrees put back where they cost least"),
        offer_bvh<BottomUpBuilder>("bvh-bottom-up",
                                   "BVH from the leaves up; nearest neighbours first"),
        offer_bvh<MortonBuilder>("bvh-morton",
                                 "linear BVH: cut where Morton codes' highest bits change"),
        offer_bvh<OverBspBuilder>("bvh-over-bsp", "boxes around chapter 3's BSP tree",
                                  [](OverBspBuilder::Config& config, const Limits& limits) {
                                      config.bsp.max_fragments = limits.references;
                                      config.bsp.max_placed = limits.placements;
                                  }),
        offer_bvh<MiddleBuilder>("bvh-middle", "BVH; the longest axis cut in the middle"),
        offer_bvh<MedianBuilder>("bvh-median", "BVH; the longest axis halved by count"),
    };
}

}  // namespace space
