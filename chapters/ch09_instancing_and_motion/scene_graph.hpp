/// @file
/// Scene graphs: objects are meshes, or groups of instances of other objects. A few dozen of them
/// describe more triangles than any memory holds.
#pragma once

#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "common/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace space {

// [scene_graph_parts]
/// An object in a place: a matrix, and which object.
struct Instance {
    Affine to_parent;          ///< from the object's local space to the space of its group
    std::uint32_t object = 0;  ///< by its index in the graph
};

/// A mesh or a group: it has triangles or instances. One that has neither is empty, and allowed.
struct GraphObject {
    std::string name;
    std::vector<Triangle> triangles = {};
    std::vector<Instance> instances = {};
};
// [scene_graph_parts]

/// What is wrong with a scene graph, in one line that names the object and the instance.
struct GraphError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One triangle of a flattened graph: whose it is, and how it got there.
struct Located {
    std::uint32_t mesh;      ///< the object that has it
    std::uint32_t triangle;  ///< its index there
    Affine to_world;         ///< the product along the path from the root down
};

/// The deepest nesting, in instances from the root to a mesh. A ray's walk calls itself once a
/// level, with a stack of some kilobytes each.
inline constexpr unsigned max_graph_height = 64;

/// Objects and the one that is the scene, the root; checked. Its triangles have an order, that of
/// flattening: depth first, a group's instances as they are listed. A triangle's index is its place
/// in this order, which takes 64 bits.
class SceneGraph {
  public:
    /// @throws GraphError for an object that holds itself, an instance of an object that there is
    /// not, a matrix that is not finite or singular, an object with triangles and instances, a mesh
    /// of more than 2^31 triangles, a graph of more than 2^63, or higher than max_graph_height
    SceneGraph(std::vector<GraphObject> objects, std::uint32_t root);

    std::span<const GraphObject> objects() const { return objects_; }
    const GraphObject& object(std::uint32_t index) const { return objects_[index]; }
    std::uint32_t root() const { return root_; }
    /// Objects below the root, and the root: each after all that it holds.
    std::span<const std::uint32_t> from_below() const { return from_below_; }
    /// Instances from an object down to its farthest mesh; 0 of a mesh.
    unsigned height(std::uint32_t object) const { return counts_[object].height; }

    /// How many triangles it has when it is flattened.
    std::uint64_t triangle_count() const { return triangle_count(root_); }
    std::uint64_t triangle_count(std::uint32_t object) const { return counts_[object].triangles; }
    /// How many triangles stand before those of an instance, in the order of its group.
    std::uint64_t first_triangle(std::uint32_t group, std::size_t instance) const {
        return counts_[group].first[instance];
    }
    /// What the graph itself keeps in memory.
    std::size_t bytes() const;

    /// The triangle of this index: its mesh, and where that stands.
    Located locate(std::uint64_t triangle) const;
    /// As it is in the flattened mesh.
    Triangle triangle(std::uint64_t index) const {
        const Located at = locate(index);
        return flattened(at.to_world, objects_[at.mesh].triangles[at.triangle]);
    }

    /// Puts other instances into a group. @throws GraphError as the constructor does; then nothing
    /// has changed
    void move(std::uint32_t group, std::vector<Instance> instances);

  private:
    struct Counts {
        std::uint64_t triangles = 0;
        unsigned height = 0;
        std::vector<std::uint64_t> first = {};  ///< by instance
    };
    void check(const GraphObject& object) const;
    void order_from_below();
    void count();

    std::vector<GraphObject> objects_;
    std::uint32_t root_;
    std::vector<std::uint32_t> from_below_;
    std::vector<Counts> counts_;  ///< by object
};

/// All triangles of the graph in the world, in their order. @throws LimitError for more than `most`
std::vector<Triangle> flatten(const SceneGraph& graph, std::uint64_t most = std::uint64_t{1} << 31);

}  // namespace space
