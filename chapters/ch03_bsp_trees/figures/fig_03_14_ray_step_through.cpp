#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/drawn_walk.hpp"

namespace space::ch03 {

Svg fig_03_14(const Options&) {
    const Story story = heinonen_story();
    const BasicRay<2> ray{.origin = {1.0f, 15.0f}, .direction = {1.0f, -0.36f}};
    return drawn_walk(
        "A ray's walk through the tree of the segments A to G, step by step, with what waits",
        story, ray, told_walk(story, ray));
}

}  // namespace space::ch03
