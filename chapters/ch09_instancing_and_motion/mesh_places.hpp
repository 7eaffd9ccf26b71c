/// @file
/// A scene graph with its groups taken apart: every mesh in each of its places, for tracers that
/// know one level of instances.
#pragma once

#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/limit_error.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace space {

/// A mesh in one of its places.
struct MeshPlace {
    std::uint32_t mesh;
    Affine to_world;
};

/// How many places with triangles there are.
inline std::uint64_t mesh_place_count(const SceneGraph& graph) {
    std::vector<std::uint64_t> counts(graph.objects().size());
    for (const std::uint32_t i : graph.from_below()) {
        counts[i] = graph.object(i).triangles.empty() ? 0 : 1;
        for (const Instance& instance : graph.object(i).instances)
            counts[i] += counts[instance.object];
    }
    return counts[graph.root()];
}

/// In the order of the flattened triangles. @throws LimitError for more than `most`
inline std::vector<MeshPlace> mesh_places(const SceneGraph& graph, std::uint64_t most) {
    const std::uint64_t count = mesh_place_count(graph);
    if (count > most)
        throw LimitError("one level of instances: " + std::to_string(count) +
                         " places of meshes, more than " + std::to_string(most));
    std::vector<MeshPlace> places;
    places.reserve(count);
    const auto place = [&](const auto& self, std::uint32_t index, const Affine& to_world) -> void {
        if (graph.triangle_count(index) == 0) return;  // or groups of nothing take for ever
        const GraphObject& object = graph.object(index);
        if (!object.triangles.empty()) places.push_back({index, to_world});
        for (const Instance& instance : object.instances)
            self(self, instance.object, composed(to_world, instance.to_parent));
    };
    place(place, graph.root(), Affine{});
    return places;
}

}  // namespace space
