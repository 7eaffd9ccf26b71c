// The build of a k-d tree, step by step.

#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/drawn_build.hpp"

namespace space::ch04 {

Svg fig_04_14(const Options&) {
    return drawn_build(heinonen_story());
}

}  // namespace space::ch04
