/// @file
/// What is compared: scenes that differ in kind, each in several sizes, and up to which size each
/// structure is asked.
#pragma once

#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/geometry.hpp"
#include "common/program/options.hpp"
#include "common/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch12 {

/// A scene that can be asked for in sizes, and what it stands for.
struct ComparedScene {
    std::string_view name, kind;
    /// Whether triangles are of about one size and fill the space about evenly: judged by eye.
    bool is_even = false;
    std::vector<std::string> specs;  ///< from small to large; those of a file are one
    /// So many times fewer pixels a row and a column, where a ray meets a good part of all.
    int coarser = 1;
};
std::span<const ComparedScene> compared_scenes();
/// @throws std::out_of_range
const ComparedScene& compared_scene(std::string_view name);

/// Up to how many triangles a structure is measured; more is beyond patience.
struct ComparedStructure {
    std::string_view name;
    std::uint64_t most_triangles;
};
std::span<const ComparedStructure> compared_structures();

/// A scene of one size, as it is traced.
struct ComparedSubject {
    std::string scene, spec;
    std::optional<SceneGraph> graph = {};  ///< of "graph/NAME:SIZE", and its triangles flattened
    std::vector<Triangle> triangles = {};
    Camera camera = {};
    std::vector<PointLight> lights = {};
    int coarser = 1;  ///< as ComparedScene's
};
/// @throws Error (bad_input) for a file that is not there
ComparedSubject make_subject(const std::string& scene, const std::string& spec, std::uint64_t seed);

/// How much is measured: for tests, for a look, for the book.
struct CompareEffort {
    int width = 64, height = 48;            ///< a ray of each kind for each pixel
    int turns = 5;                          ///< of what is not slow; 0: counts alone
    int most_turns = 7;                     ///< of what is quick
    std::uint64_t most_placed = 3'000'000;  ///< by a BSP tree's builder (BuildOptions)
    /// Scene and spec, small ones first; of files those that are there.
    std::vector<std::pair<std::string, std::string>> blocks = {};
};
CompareEffort compare_effort(const Options& options);

}  // namespace space::ch12
