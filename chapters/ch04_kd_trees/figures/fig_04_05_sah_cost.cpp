// The cost of planes across one axis of a cell, by boxes of whole segments and of their parts.

#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/drawn_costs.hpp"

namespace space::ch04 {

Svg fig_04_05(const Options&) {
    return drawn_costs({}).drawing;
}

}  // namespace space::ch04
