/// @file
/// A linear octree of triangles, made to be built fast: each triangle once, in the cell that its
/// middle lies in, and with each cell a box of what its triangles fill. Such a box may reach beyond
/// its cell, and is often far smaller. Nothing is cut or named twice, and no triangle is held
/// against a cell: the build is codes, a sort, and two passes over the nodes.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/linear_orthtree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/morton_order.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// Segments (D = 2) or triangles (D = 3) by the codes of their boxes' middles.
template <int D>
struct BoxedOrthtree {
    LinearOrthtree<D> cells = {};
    std::vector<BasicAabb<D>> boxes = {};      ///< of the nodes, around all that is in them
    std::vector<std::uint32_t> polygons = {};  ///< the cells' items

    // [boxed_build]
    /// @throws LimitError for more than 2^32 - 1 polygons
    template <class Observer = NoObserver>
    static BoxedOrthtree build(std::span<const Simplex<D>> polygons,
                               const LinearOrthtreeConfig& config = {}, Observer&& observer = {}) {
        if (polygons.size() > std::numeric_limits<std::uint32_t>::max())
            throw LimitError("linear orthtree: more than 4294967295 polygons");
        std::vector<BasicAabb<D>> own(polygons.size());
        std::vector<Point<D>> middles(polygons.size());
        BasicAabb<D> around_middles;
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            own[i] = box_if_finite<D>(polygons[i]);
            if (own[i].is_empty()) continue;  // it may stand anywhere
            middles[i] = own[i].centroid();
            around_middles.extend(middles[i]);
        }
        auto [codes, indices] = morton_order<D>(OrthtreeFrame<D>::around(around_middles), middles);
        BoxedOrthtree tree;
        tree.cells = LinearOrthtree<D>::build(std::move(codes), config, observer);
        tree.polygons = std::move(indices);
        tree.boxes = boxes_around(tree.cells, [&](BasicAabb<D>& box, std::uint32_t item) {
            box.extend(own[tree.polygons[item]]);
        });
        return tree;
    }
    // [boxed_build]
};

/// Event: the walk has come to a node, with this part of the ray in its box.
struct BoxVisit {
    std::uint32_t node;
    RayPart part;
};

// [walk_boxes]
/// Walks the boxes that a ray meets, of a node's children the one first that it enters first. Calls
/// own(node) for every leaf; it returns the t beyond which nothing matters any more (NaN: nothing
/// at all). Boxes may overlap, so a hit ends nothing before all boxes in front of it are through.
template <int D, class Counts, class Own, class Observer = NoObserver>
void walk_boxes(const BoxedOrthtree<D>& tree, const BasicRay<D>& ray, Counts& counts,
                const Own& own, Observer&& observer = {}) {
    if (!is_valid(ray) || tree.cells.empty()) return;
    const KdRay<D> prepared(ray);
    RayPart whole = RayPart::all_of(ray);
    // At each depth the children of one cell, of which one is gone on to.
    std::array<BoxVisit, 1 + max_orthtree_depth<D>*(orthants<D> - 1)> waiting;
    std::size_t size = 0;
    const auto consider = [&](std::uint32_t node, std::size_t first) {
        const auto part = part_in(tree.boxes[node], prepared, whole);
        if (!part) return;
        std::size_t at = size++;
        for (; at > first && waiting[at - 1].part.enter < part->enter; --at)
            waiting[at] = waiting[at - 1];
        waiting[at] = {node, *part};
    };
    consider(0, 0);
    while (size > 0) {
        const BoxVisit visit = waiting[--size];
        if (!(visit.part.enter <= whole.leave)) continue;
        counts.visit_node();
        observer.observe(visit);
        const auto& node = tree.cells.nodes[visit.node];
        if (node.is_leaf()) {
            const double limit = own(visit.node);
            if (std::isnan(limit)) return;
            whole.leave = std::min(whole.leave, limit);
            continue;
        }
        const std::size_t first = size;
        const auto children = static_cast<std::uint32_t>(tree.cells.children(node).size());
        for (std::uint32_t i = children; i-- > 0;) consider(node.children + i, first);
    }
}
// [walk_boxes]

/// Small leaves, as a box costs less than a triangle; no chains, whose boxes are all the same.
struct LinearOctreeConfig {
    LinearOrthtreeConfig cells = {.leaf_size = 4, .skip_chains = true};
};

/// The accelerator. With the exact test its answers are those of the naive loop, bit for bit.
template <TriangleTest Test = FilteredExact>
class LinearOctree {
  public:
    using Config = LinearOctreeConfig;

    template <class Observer = NoObserver>
    static LinearOctree build(std::span<const Triangle> triangles, const Config& config = {},
                              Observer&& observer = {}) {
        LinearOctree octree;
        octree.tree_ = BoxedOrthtree<3>::build(triangles, config.cells, observer);
        octree.triangles_.reserve(triangles.size());
        for (const std::uint32_t triangle : octree.tree_.polygons)
            octree.triangles_.push_back(triangles[triangle]);
        return octree;
    }
    const BoxedOrthtree<3>& tree() const { return tree_; }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        return nearest_found([&](const auto& found) { search(ray, counts, found); });
    }

    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        return is_any_found([&](const auto& found) { search(ray, counts, found); });
    }

    TreeShape shape() const {
        const auto& nodes = tree_.cells.nodes;
        std::size_t leaves = 0, depth = 0;
        std::vector<std::uint8_t> edges(nodes.size());  // from the root
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            leaves += nodes[i].is_leaf();
            depth = std::max<std::size_t>(depth, edges[i]);
            const std::size_t children = tree_.cells.children(nodes[i]).size();
            for (std::size_t k = 0; k < children; ++k)
                edges[nodes[i].children + k] = static_cast<std::uint8_t>(edges[i] + 1);
        }
        using Cells = LinearOrthtree<3>;
        return {.nodes = nodes.size(),
                .leaves = leaves,
                .depth = depth,
                .references = triangles_.size(),
                .bytes = sizeof *this + nodes.size() * (sizeof(Cells::Node) + sizeof(Aabb)) +
                         triangles_.size() *
                             (sizeof(Triangle) + sizeof(std::uint32_t) + sizeof(std::uint64_t))};
    }

  private:
    // [search]
    /// Calls found(hit) for the hits of every triangle in the leaves that the ray comes to; it
    /// returns the t beyond which nothing matters any more.
    template <class Counts, class Found>
    void search(const Ray& ray, Counts& counts, const Found& found) const {
        double limit = infinity;
        walk_boxes(tree_, ray, counts, [&](std::uint32_t leaf) {
            const auto& node = tree_.cells.nodes[leaf];
            for (std::uint32_t place = node.first; place < node.last; ++place) {
                counts.test_triangle();
                if (auto hit = Test::intersect(ray, triangles_[place])) {
                    hit->triangle = tree_.polygons[place];
                    limit = found(*hit);
                }
            }
            return limit;
        });
    }
    // [search]

    BoxedOrthtree<3> tree_;
    std::vector<Triangle> triangles_;  ///< copies, in the order of the cells' items
};

}  // namespace space
