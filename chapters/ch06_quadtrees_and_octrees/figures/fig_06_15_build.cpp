// A quadtree of points, built step by step.

#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures/drawn_points.hpp"

namespace space::ch06 {

Svg fig_06_15(const Options&) {
    return drawn_points({}).drawing;
}

}  // namespace space::ch06
