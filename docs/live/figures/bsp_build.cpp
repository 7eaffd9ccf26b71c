#include "chapters/ch03_bsp_trees/figures/drawn_build.hpp"
#include "docs/live/bsp_scene.hpp"

#include <utility>

namespace space::live {

Answer bsp_build(const State& state) {
    PlaneHandles handles(state);
    BspScene scene = bsp_scene(state, ch03::build_view(), handles);
    return {.drawing = ch03::drawn_build(
                "The segments A to G and the tree that the builder has made of them, step by step",
                scene.story),
            .summary = ch03::summed_up(scene.story),
            .handles = std::move(handles.handles),
            .choices = std::move(scene.choices),
            .sliders = std::move(scene.sliders)};
}

}  // namespace space::live
