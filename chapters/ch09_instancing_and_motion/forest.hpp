/// @file
/// A forest: a few trees, each a few hundred times a bough or a twig, in very many places.
#pragma once

#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"

#include <cstdint>

namespace space {

/// size x size places on hills, four units apart, most with one of six trees, turned and scaled at
/// random. A tree has some 15,000 triangles. z is up; the middle is at (0, 0).
SceneGraph make_forest_graph(std::uint32_t size, std::uint64_t seed = 1);

/// The height of its ground.
double forest_ground(double x, double y);

}  // namespace space
