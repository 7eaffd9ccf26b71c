// Morton codes, and the curve of all cells in their order.

#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures/drawn_curve.hpp"

namespace space::ch06 {

Svg fig_06_09(const Options&) {
    return drawn_curve({}).drawing;
}

}  // namespace space::ch06
