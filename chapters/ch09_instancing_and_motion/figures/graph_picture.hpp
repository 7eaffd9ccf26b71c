/// @file
/// Pictures of scene graphs: the sun with its shadows, the sky, and haze.
#pragma once

#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/camera.hpp"
#include "common/program/image.hpp"
#include "common/scene.hpp"

#include <cstdint>
#include <functional>

namespace space::ch09 {

/// What a picture is of, and the light there.
struct GraphPicture {
    const SceneGraph& graph;
    const InstancedTrees& trees;
    Camera camera;
    Double3 to_sun;  ///< any length
    Double3 up{0.0, 0.0, 1.0};
    Color sun, sky, ground;   ///< from the sun, from above, from below
    Color haze;               ///< where nothing is near, and behind all
    double clear = infinity;  ///< the distance at which haze hides all but 1 / e
    std::function<Color(const Located& at, std::uint64_t triangle)> color;
    int samples = 2;  ///< per pixel: so many in a row and in a column
};

/// Every ray is traced exactly; the same bytes for any number of threads.
Image render(const GraphPicture& picture, int width, int height, unsigned threads);

}  // namespace space::ch09
