/// @file
/// What the lab is asked about: a mesh, one of the book's scenes, or a scene of instances.
#pragma once

#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "chapters/ch12_comparison/lab_options.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace space {

/// What is asked, as the options have it.
struct Subject {
    Scene scene;  ///< of a graph: name and camera, and a box that it fills
    std::optional<SceneGraph> graph = {};
    std::vector<Triangle> triangles = {};
    std::size_t degenerate = 0;

    Geometry geometry() const { return {triangles, graph ? &*graph : nullptr}; }
    Triangle triangle(std::uint64_t i) const { return graph ? graph->triangle(i) : triangles[i]; }
};

/// Reads or makes it. @throws Error (usage) where nothing is asked or --flatten is too much,
/// (bad_input) for a broken file
Subject subject_of(const LabOptions& options);

}  // namespace space
