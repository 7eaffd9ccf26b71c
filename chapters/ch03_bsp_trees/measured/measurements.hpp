/// @file
/// How chapter 3 counts and times: trees by splitter, their growth, rays through them, and how
/// exactly fragments tile their polygons.
#pragma once

#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "chapters/ch03_bsp_trees/measured/data.hpp"
#include "common/program/options.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch03 {

using SplitterChoice = BspConfig::SplitterChoice;
using Straddlers = BspConfig::Straddlers;

/// How trees are built, by the names that tables and options use.
struct Method {
    std::string_view name;
    SplitterChoice splitter;
    Straddlers straddlers = Straddlers::split;
};
inline constexpr std::array methods{
    Method{"first", SplitterChoice::first},
    Method{"random", SplitterChoice::random},
    Method{"balanced", SplitterChoice::balanced},
    Method{"fewest", SplitterChoice::fewest_splits},
    Method{"weighted", SplitterChoice::weighted},
    Method{"free", SplitterChoice::free},
    Method{"shared", SplitterChoice::weighted, Straddlers::share},
};
inline constexpr std::array grades{Grade::thick_float, Grade::ordered_float, Grade::ordered_double,
                                   Grade::exact};  ///< in the order of grade_names

/// How far measurements go.
struct Limits {
    std::size_t sizes;             ///< of each growing scene
    std::uint64_t max_classified;  ///< polygons against planes, in one build
    std::size_t max_fragments;
    std::size_t rays, edge_rays;  ///< through each tree; at edges and at cuts of a closed mesh
    int rounds;                   ///< of timed builds
};
Limits limits(Amount amount);
/// Some 2 GB, and half a minute: where the chapter gives a scene's tree up.
inline constexpr std::size_t max_scene_fragments = 5'000'000;
inline constexpr std::uint64_t max_scene_placed = 100'000'000;

/// What is built, and what the answers of the naive loop are.
struct TreeTask {
    std::string scene;
    std::vector<Triangle> triangles;
    std::vector<Ray> rays;
    std::vector<std::optional<Hit>> truth;

    TreeTask(std::string name, std::vector<Triangle> all, const Options& options);
};
/// @throws LimitError where the tree would have more than max_fragments
TreePoint measure_tree(const TreeTask& task, const Method& method, std::size_t max_fragments,
                       std::uint64_t max_placed = BspConfig{}.max_placed);

MethodTrees measure_methods(const std::string& scene, const Options& options);
/// Scenes whose size is what it is, by three methods; those on this machine.
std::vector<TreePoint> measure_scenes(const Options& options);

std::vector<Growth> measure_growth(const Options& options);
std::vector<Crossings> measure_crossings(const Options& options);
std::vector<GradePoint> measure_grades(const Options& options);
/// Algorithm 2 as printed, on three scenes.
std::vector<PrintedTree> build_as_printed(const Options& options);

}  // namespace space::ch03
