/// @file
/// A scene graph in a file, as JSON:
///
///     {"meshes": {"bunny": "bunny.ply", "tree": "tree:5"},
///      "groups": {
///        "pair": [{"object": "bunny"},
///                 {"object": "bunny", "matrix": [[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0]]}],
///        "garden": [{"object": "pair"}, {"object": "tree"}]},
///      "scene": "garden"}
///
/// A mesh is a file (OBJ, OFF, PLY, STL), named from the folder of this one, or a scene of the
/// book. A group is a list of instances of meshes and groups, in any order, but none may hold
/// itself. The matrix takes points of the object to points of the group: three rows of four
/// numbers. Without it the object stands where it is.
#pragma once

#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace space {

/// A graph, and what the readers of its meshes passed over.
struct InstanceFile {
    SceneGraph graph;
    std::vector<std::string> remarks;
};

/// @throws Error (bad_input) with one line that names the file, the line in it and the fault
InstanceFile load_instances(const std::filesystem::path& file);

/// The files that it names, for who must not write over them; none where it is not to be read.
std::vector<std::filesystem::path> meshes_of_instances(const std::filesystem::path& file);

}  // namespace space
