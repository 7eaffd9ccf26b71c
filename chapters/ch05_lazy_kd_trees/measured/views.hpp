/// @file
/// Scenes with several views: a mesh on a floor as Johnston06 has the killeroos, and a field of
/// plants of our own.
#pragma once

#include "common/program/options.hpp"
#include "common/scene.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch05 {

/// A camera with a name.
struct View {
    std::string_view name;
    Camera camera;
};

/// One scene, seen from several places.
struct ViewedScene {
    Scene scene;
    std::vector<View> views;

    /// The scene, seen so.
    Scene seen(const View& view) const {
        Scene copy = scene;
        copy.camera = view.camera;
        return copy;
    }
};

/// The mesh on a floor between two walls: all of it, with the back to it, and a small part of it.
ViewedScene on_floor(std::string name, const TriangleMesh& mesh);
/// `along` plants along each side of a field, no two alike; seen from its side, and one from above.
ViewedScene plants(std::uint32_t along, std::uint64_t seed);

/// The scenes of the table. Only the first and the last where seconds count.
std::vector<ViewedScene> viewed_scenes(const Options& options);

}  // namespace space::ch05
