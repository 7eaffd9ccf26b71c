/// @file
/// The trees of a scene graph: one for each mesh, over its triangles in its own space, and one for
/// each group, over its instances' boxes. As many as there are objects, however often they stand.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

// [placed_instance]
/// An instance as a ray needs it. Margins are by axis; instanced_ray.hpp tells what they are for.
struct PlacedInstance {
    Affine to_parent, to_local;
    Double3 local_margin;          ///< of to_local, which is no exact inverse; in local space
    Double3 world_margin;          ///< of what flattening rounds, where the group is the root
    std::uint64_t first_triangle;  ///< in the order of the group
    std::uint32_t object;
    bool may_overflow;  ///< a vertex may be farther out than floats reach
};
// [placed_instance]

/// The tree of an object, and what its leaves name, in their order: triangles of a mesh, instances
/// of a group.
struct ObjectTree {
    BvhNodes<3> nodes;
    std::vector<Triangle, CacheLineAllocator<Triangle>> triangles = {};
    std::vector<PlacedInstance, CacheLineAllocator<PlacedInstance>> instances = {};
    /// How large coordinates may be on the way from below, by axis: sums of sizes, so that they
    /// hold for all that is computed on the way, too.
    Double3 reach{0.0};

    bool is_group() const { return !instances.empty(); }
    Aabb box() const { return nodes.empty() ? Aabb{} : nodes.nodes[0].box; }
};

/// By object of the graph. What the root does not hold has no tree.
class InstancedTrees {
  public:
    /// How the trees are built: over meshes, and over instances, of which a leaf has one.
    struct Config {
        BinnedBuilder::Config meshes = {};
        BinnedBuilder::Config groups = {.max_leaf_size = 1};
    };

    /// @throws LimitError where a tree is deeper than the stack of a ray's walk
    /// @throws GraphError where the box of a group's instance is larger than floats can be; of the
    /// root's, nothing beyond them is in the flattened mesh, either
    static InstancedTrees build(const SceneGraph& graph, const Config& config);
    static InstancedTrees build(const SceneGraph& graph) { return build(graph, {}); }

    /// Builds the trees over instances anew: of all groups of the graph, whose meshes are those of
    /// before.
    void rebuild_groups(const SceneGraph& graph);

    const ObjectTree& root() const { return trees_[root_]; }
    const ObjectTree& tree(std::uint32_t object) const { return trees_[object]; }
    /// What the trees keep in memory.
    std::size_t bytes() const;
    std::size_t nodes() const;

  private:
    ObjectTree group_tree(const SceneGraph& graph, std::uint32_t group) const;

    Config config_;
    std::vector<ObjectTree> trees_;
    std::uint32_t root_ = 0;
};

}  // namespace space
