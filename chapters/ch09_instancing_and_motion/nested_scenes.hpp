/// @file
/// Scenes of a mesh in very many places: the self-similar ones of Haines's databases, whose
/// triangles grow as a power of the levels, and whose graphs by one group a level.
#pragma once

#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace space {

/// A sphere carries nine of a third of its radius, and so on, `levels` times (0: one sphere, of 320
/// triangles): 40 (9^(levels + 1) - 1) triangles. Radius 0.5, at the origin; z is up. (Haines 1987,
/// "balls". There the nine are turned about the direction from the parent in some other way at each
/// place; here every one is its parent, smaller.)
SceneGraph nested_sphereflake(std::uint32_t levels);

/// Sierpinski's tetrahedron on alternate corners of the cube from -1 to 1: 4^(levels + 1)
/// triangles. All coordinates are exact in float up to 22 levels.
SceneGraph nested_tetra(std::uint32_t levels);

/// Three crossed bars with balls at their ends, and eight of half the size in the octants: 528
/// (8^(levels + 1) - 1) / 7 triangles.
SceneGraph nested_jacks(std::uint32_t levels);

/// A scene graph that can be asked for by name.
struct NestedRecipe {
    std::string_view name, about;
    std::uint32_t default_size, max_size;
    SceneGraph (*make)(std::uint32_t size);
};
std::span<const NestedRecipe> nested_recipes();

/// "NAME" or "NAME:SIZE". @throws Error (usage)
SceneGraph make_nested_scene(std::string_view spec);

}  // namespace space
