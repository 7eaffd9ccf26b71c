// One T, one R, one S, in the six orders that three things have.

#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/drawn_placing.hpp"

namespace space::ch09 {

Svg fig_09_05(const Options&) {
    return drawn_orders(ordered_first);
}

}  // namespace space::ch09
