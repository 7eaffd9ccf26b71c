#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/drawn_build.hpp"

namespace space::ch03 {

Svg fig_03_13(const Options&) {
    return drawn_build(
        "The segments A to G and the tree that the builder has made of them, step by step",
        heinonen_story());
}

}  // namespace space::ch03
