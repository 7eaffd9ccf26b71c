#include "chapters/ch07_bounding_volume_hierarchies/measured/any_builder.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bottom_up_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/data.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/middle_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/optimised_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/over_bsp_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"

namespace space::ch07 {

const std::vector<NamedBuilder>& builders() {
    static const std::vector<NamedBuilder> all{{by_bins, any<BinnedBuilder>()},
                                               {by_median, any<MedianBuilder>()},
                                               {by_middle, any<MiddleBuilder>()},
                                               {by_morton, any<MortonBuilder>()},
                                               {by_sweep, any<SweepBuilder>()},
                                               {by_spatial, any<SpatialSplitBuilder>()},
                                               {by_bottom_up, any<BottomUpBuilder>(), 600'000},
                                               {by_optimiser, any<OptimisedBuilder>(), 300'000},
                                               {by_bsp, any<OverBspBuilder>(), 20'000}};
    return all;
}

}  // namespace space::ch07
