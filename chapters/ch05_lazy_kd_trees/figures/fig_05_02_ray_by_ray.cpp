// A lazy tree over the segments A to G, ray by ray.

#include "chapters/ch05_lazy_kd_trees/figures.hpp"
#include "chapters/ch05_lazy_kd_trees/figures/drawn_rays.hpp"

namespace space::ch05 {

Svg fig_05_02(const Options&) {
    return drawn_rays({}).drawing;
}

}  // namespace space::ch05
