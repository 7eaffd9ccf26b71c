// M = T R S, step by step, and what another order or a mirror does.

#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/drawn_placing.hpp"

namespace space::ch09 {

Svg fig_09_04(const Options&) {
    return drawn_placing(placed_first);
}

}  // namespace space::ch09
