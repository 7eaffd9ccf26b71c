/// @file
/// The accelerators: trees of a scene graph, over any triangle test and either leaf test; and the
/// same over plain triangles, which are put into spaces of their own first. So whoever examines
/// structures can examine these.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/pcg32.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// Of all trees together; the depth is that of the longest way from the root to a triangle.
inline TreeShape shape_of(const InstancedTrees& trees, const SceneGraph& graph) {
    TreeShape shape{.nodes = 0, .leaves = 0, .depth = 0, .bytes = trees.bytes()};
    std::vector<std::size_t> depth(graph.objects().size());
    for (const std::uint32_t object : graph.from_below()) {
        const ObjectTree& tree = trees.tree(object);
        *shape.nodes += tree.nodes.size();
        tree.nodes.for_each_node([&](std::uint32_t node, unsigned) {
            *shape.leaves += tree.nodes.nodes[node].is_leaf();
        });
        shape.references += tree.triangles.size();
        for (const PlacedInstance& instance : tree.instances)
            depth[object] = std::max(depth[object], depth[instance.object]);
        depth[object] += tree.nodes.depth;
    }
    shape.depth = depth[graph.root()];
    return shape;
}

/// A scene graph's trees. Its hits are of the flattened mesh, whose triangles take 64 bits to
/// count.
template <TriangleTest Test = FilteredExact, LeafTest leaf = LeafTest::world>
class InstancedBvh {
  public:
    using Config = InstancedTrees::Config;

    static InstancedBvh build(const SceneGraph& graph, const Config& config = {}) {
        InstancedBvh bvh{InstancedTrees::build(graph, config), {}};
        bvh.shape_ = shape_of(bvh.trees_, graph);
        return bvh;
    }
    template <class Counts>
    std::optional<PlacedHit> closest_hit(const Ray& ray, Counts& counts) const {
        return closest_placed_hit<Test, InstancedWay{.leaf = leaf}>(trees_, ray, counts);
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        return any_placed_hit<Test, InstancedWay{.leaf = leaf}>(trees_, ray, counts);
    }
    const TreeShape& shape() const { return shape_; }

  private:
    InstancedBvh(InstancedTrees trees, TreeShape shape)
        : trees_(std::move(trees)), shape_(std::move(shape)) {}

    InstancedTrees trees_;
    TreeShape shape_;
};

/// A matrix with one entry a row and a column, a power of 2 from 1/8 to 8.
inline Affine exact_map(Pcg32& random, LeafTest leaf) {
    std::array<std::size_t, 3> axes{0, 1, 2};
    std::array<double, 3> signs{1, 1, 1};
    if (leaf == LeafTest::world) {
        std::swap(axes[2], axes[random.below(3)]);
        std::swap(axes[1], axes[random.below(2)]);
        for (double& sign : signs) sign = random.below(2) == 0 ? 1.0 : -1.0;
    }
    const double unit = std::ldexp(1.0, static_cast<int>(random.below(7)) - 3);
    Affine map{{{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}}};
    for (std::size_t axis = 0; axis < 3; ++axis) map.rows[axis][axes[axis]] = signs[axis] * unit;
    return map;
}

// [in_pieces]
/// A graph whose flattened triangles are these, bit for bit: pieces of them, each brought into a
/// space of its own by a matrix whose products are exact. Its unit is a power of 2, and for
/// LeafTest::world its axes are mirrored and change places, too. (The local test would see its sums
/// in another order then, and zeros of the other sign.) A piece whose coordinates are so near to
/// the ends of float that the way there and back changes them stays as it is; for LeafTest::local,
/// too, where products of coordinates come there.
inline SceneGraph in_pieces(std::span<const Triangle> triangles, std::size_t pieces,
                            LeafTest leaf) {
    Pcg32 random(9);
    GraphObject root{"pieces"};
    std::vector<GraphObject> objects;
    pieces = std::min(pieces, triangles.size());
    for (std::size_t i = 0; i < pieces; ++i) {
        const std::size_t first = i * triangles.size() / pieces,
                          last = (i + 1) * triangles.size() / pieces;
        const auto piece = triangles.subspan(first, last - first);
        const Affine to_parent = exact_map(random, leaf), to_local = *inverse(to_parent);
        GraphObject mesh{"piece " + std::to_string(i + 1)};
        for (const Triangle& triangle : piece)
            mesh.triangles.push_back(flattened(to_local, triangle));
        const bool goes =
            std::ranges::equal(piece, mesh.triangles, {}, {},
                               [&](const Triangle& local) { return flattened(to_parent, local); });
        if (!goes) mesh.triangles.assign(piece.begin(), piece.end());
        root.instances.push_back({goes ? to_parent : Affine{}, static_cast<std::uint32_t>(i)});
        objects.push_back(std::move(mesh));
    }
    objects.push_back(std::move(root));
    return {std::move(objects), static_cast<std::uint32_t>(pieces)};
}
// [in_pieces]

/// How many spaces plain triangles are brought into.
struct InstancedPiecesConfig {
    std::size_t pieces = 24;
};

/// Plain triangles as instances, for whoever has no graph.
template <LeafTest leaf, TriangleTest Test = FilteredExact>
class InstancedPieces {
  public:
    using Config = InstancedPiecesConfig;

    static InstancedPieces build(std::span<const Triangle> triangles, const Config& config = {}) {
        return InstancedPieces(
            InstancedBvh<Test, leaf>::build(in_pieces(triangles, config.pieces, leaf)));
    }
    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        const std::optional<PlacedHit> hit = bvh_.closest_hit(ray, counts);
        if (!hit) return std::nullopt;
        return Hit{hit->t, static_cast<std::uint32_t>(hit->triangle), hit->u, hit->v};
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        return bvh_.any_hit(ray, counts);
    }
    TreeShape shape() const { return bvh_.shape(); }

  private:
    explicit InstancedPieces(InstancedBvh<Test, leaf> bvh) : bvh_(std::move(bvh)) {}

    InstancedBvh<Test, leaf> bvh_;
};

/// The exact way.
template <TriangleTest Test = FilteredExact>
using WorldInstances = InstancedPieces<LeafTest::world, Test>;
/// The usual one.
template <TriangleTest Test = FilteredExact>
using LocalInstances = InstancedPieces<LeafTest::local, Test>;

}  // namespace space
