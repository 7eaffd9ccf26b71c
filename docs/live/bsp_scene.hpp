/// @file
/// What both live figures of chapter 3 let their reader move: the segments A to G and the choice of
/// splitters.
#pragma once

#include "chapters/ch03_bsp_trees/figures/recorded_build.hpp"
#include "docs/live/plane_handles.hpp"

#include <vector>

namespace space::live {

/// A tree, and what else than its segments' ends it can be changed by.
struct BspScene {
    ch03::Story story;
    std::vector<Choice> choices;
    std::vector<Slider> sliders;
};

/// Asks where the segments' ends are, in a view of their square.
BspScene bsp_scene(const State& state, const PlaneView& view, PlaneHandles& handles);

}  // namespace space::live
