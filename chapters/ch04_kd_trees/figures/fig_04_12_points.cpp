// What two searches look at in a tree of points.

#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/drawn_searches.hpp"

namespace space::ch04 {

Svg fig_04_12(const Options&) {
    return drawn_searches({}).drawing;
}

}  // namespace space::ch04
