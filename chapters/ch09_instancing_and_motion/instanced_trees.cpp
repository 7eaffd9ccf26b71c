#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "chapters/ch09_instancing_and_motion/transformed_box.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace space {
namespace {

/// The largest coordinate of a box, by axis.
Double3 reach_of(const Aabb& box) {
    return box.is_empty() ? Double3(0.0) : Double3(glm::max(glm::abs(box.min), glm::abs(box.max)));
}

/// Half of a float's last place, by which a double is rounded at most that becomes no larger than
/// x.
double half_place(double x) {
    return std::ldexp(1.0, std::max(std::ilogb(x), -126) - 24);
}

ObjectTree mesh_tree(std::span<const Triangle> triangles, const BinnedBuilder::Config& config) {
    ObjectTree tree{.nodes = BinnedBuilder::build<3>(triangles, config)};
    if (tree.nodes.depth > max_bvh_depth)
        throw LimitError("instanced trees: deeper than " + std::to_string(max_bvh_depth));
    for (const std::uint32_t i : tree.nodes.references) tree.triangles.push_back(triangles[i]);
    tree.reach = reach_of(tree.box());
    return tree;
}

// [placed]
/// An instance of what `below` is the tree of, and its box in the space of its group.
///
/// `path_margin`: with u53 = 2^-53, a path of n matrices is multiplied from the top down. Each of
/// n - 1 products adds at most four roundings to an entry, and the product with a vertex four more:
/// what flattening computes in double is off by at most 4 n u53 of the sum of all terms' sizes,
/// which `reach` is above, but for terms with u53^2 and the roundings of `reach`; 5 n u53 is more.
struct Placed {
    PlacedInstance instance;
    Aabb box;
    Double3 reach;

    Placed(const Instance& from, const ObjectTree& below, unsigned height, std::uint64_t first) {
        const Affine to_local = *inverse(from.to_parent);
        reach = from.to_parent.size_of_point(below.reach);
        const Double3 path_margin = 5.0 * height * 0x1p-53 * reach;
        box = transformed_box(from.to_parent, below.box(), path_margin);
        instance = {.to_parent = from.to_parent,
                    .to_local = to_local,
                    .local_margin = local_margin(to_local, from.to_parent, below.reach),
                    .world_margin = rounded_by(box) + path_margin,
                    .first_triangle = first,
                    .object = from.object,
                    .may_overflow = false};
        for (int axis = 0; axis < 3; ++axis)
            instance.may_overflow =
                instance.may_overflow || box.min[axis] == -largest || box.max[axis] == largest;
    }

  private:
    static constexpr float largest = std::numeric_limits<float>::max();

    static Double3 rounded_by(const Aabb& world) {
        const Double3 w = reach_of(world);
        return {half_place(w.x), half_place(w.y), half_place(w.z)};
    }
    /// How far to_local takes a point that to_parent brought, from where it was: residual takes
    /// care of its own roundings. The translation's part of a ray's origin is rounded, too.
    static Double3 local_margin(const Affine& to_local, const Affine& to_parent,
                                const Double3& reach) {
        return residual(to_local, to_parent).size_of_point(reach) +
               6.0 * 0x1p-53 * glm::abs(to_local.translation()) + 0x1p-149;
    }
};
// [placed]

}  // namespace

InstancedTrees InstancedTrees::build(const SceneGraph& graph, const Config& config) {
    InstancedTrees all;
    all.config_ = config;
    all.trees_.resize(graph.objects().size());
    all.rebuild_groups(graph);
    return all;
}

void InstancedTrees::rebuild_groups(const SceneGraph& graph) {
    for (const std::uint32_t i : graph.from_below()) {
        const std::vector<Triangle>& triangles = graph.object(i).triangles;
        if (triangles.empty())
            trees_[i] = group_tree(graph, i);
        else if (trees_[i].nodes.empty())  // of one that the root did not hold before, too
            trees_[i] = mesh_tree(triangles, config_.meshes);
    }
    root_ = graph.root();
}

// [group_tree]
ObjectTree InstancedTrees::group_tree(const SceneGraph& graph, std::uint32_t group) const {
    const std::vector<Instance>& instances = graph.object(group).instances;
    limit_polygons(instances.size());
    const auto placed = [&](std::size_t i) {
        return Placed(instances[i], trees_[instances[i].object], graph.height(group),
                      graph.first_triangle(group, i));
    };
    ObjectTree tree;
    std::vector<BvhReference<3>> boxes;
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Placed one = placed(i);
        if (one.box.is_empty()) continue;  // nothing there that a ray can hit
        if (one.instance.may_overflow && group != graph.root())
            throw GraphError("group \"" + graph.object(group).name + "\", instance " +
                             std::to_string(i + 1) + ": its box is larger than floats can be");
        boxes.push_back({one.box, static_cast<std::uint32_t>(i)});
        tree.reach = glm::max(tree.reach, one.reach);
    }
    NoObserver nobody;
    tree.nodes =
        build_top_down<3>(std::move(boxes), config_.groups.max_leaf_size, config_.groups.max_depth,
                          BinnedBuilder::Choice<3>{config_.groups}, nobody);
    tree.instances.reserve(tree.nodes.references.size());
    for (const std::uint32_t i : tree.nodes.references)
        tree.instances.push_back(placed(i).instance);
    return tree;
}
// [group_tree]

std::size_t InstancedTrees::bytes() const {
    std::size_t bytes = sizeof *this;
    for (const ObjectTree& tree : trees_)
        bytes += sizeof tree + tree.nodes.nodes.size() * sizeof(BvhNode<3>) +
                 tree.nodes.references.size() * sizeof(std::uint32_t) +
                 tree.triangles.size() * sizeof(Triangle) +
                 tree.instances.size() * sizeof(PlacedInstance);
    return bytes;
}

std::size_t InstancedTrees::nodes() const {
    std::size_t nodes = 0;
    for (const ObjectTree& tree : trees_) nodes += tree.nodes.size();
    return nodes;
}

}  // namespace space
