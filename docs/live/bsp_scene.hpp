/// @file
/// What both live figures of chapter 3 let their reader move: the segments A to G and the choice of
/// splitters.
#pragma once

#include "chapters/ch03_bsp_trees/figures/recorded_build.hpp"
#include "docs/live/live.hpp"

#include <vector>

namespace space::live {

/// A tree, and what it can be changed by.
struct BspScene {
    ch03::Story story;
    std::vector<Handle> handles;
    std::vector<Choice> choices;
    std::vector<Slider> sliders;
};

/// The square of the segments is drawn in the view.
BspScene bsp_scene(const State& state, const PlaneView& view);

}  // namespace space::live
