/// @file
/// The octree over triangles: tight, with straddlers kept, or loose.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch04_kd_trees/mailbox.hpp"
#include "chapters/ch04_kd_trees/placed_triangles.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_builder.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_config.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_nodes.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_walk.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace space {

/// The accelerator. With the exact test its answers are those of the naive loop, bit for bit.
template <TriangleTest Test = FilteredExact>
class Octree {
  public:
    using Config = OctreeConfig;

    template <class Observer = NoObserver>
    static Octree build(std::span<const Triangle> triangles, const Config& config = {},
                        Observer&& observer = {}) {
        Octree tree;
        tree.nodes_ = OrthtreeBuilder<3>::build(triangles, config, observer);
        tree.placed_ = PlacedTriangles::of(triangles, tree.nodes_.references);
        tree.config_ = config;
        return tree;
    }
    const OrthtreeNodes<3>& nodes() const { return nodes_; }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        return nearest_found([&](const auto& found) { search(ray, counts, found); });
    }

    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        return is_any_found([&](const auto& found) { search(ray, counts, found); });
    }

    TreeShape shape() const {
        std::size_t leaves = 0;
        double cost = 0.0;
        nodes_.for_each_cell([&](std::uint32_t index, const OrthtreeCell<3>& cell) {
            const OrthtreeNode& node = nodes_.nodes[index];
            leaves += node.is_leaf();
            cost += std::ldexp((node.is_leaf() ? 0.0 : config_.costs.traversal) +
                                   config_.costs.intersection * double(node.count),
                               -2 * static_cast<int>(cell.depth));  // its surface, the root's is 1
        });
        return {.nodes = nodes_.nodes.size(),
                .leaves = leaves,
                .depth = nodes_.depth,
                .references = nodes_.references.size(),
                .bytes = sizeof *this + nodes_.nodes.size() * sizeof(OrthtreeNode) +
                         nodes_.references.size() * sizeof(std::uint32_t) + placed_.bytes(),
                .sah_cost = nodes_.empty() ? std::nullopt : std::optional(cost)};
    }

  private:
    // [search]
    /// Calls found(hit) for the hits of every triangle that is named where the ray passes; it
    /// returns the t beyond which nothing matters any more.
    template <class Counts, class Found>
    void search(const Ray& ray, Counts& counts, const Found& found) const {
        const bool remembers =
            config_.mailboxes && config_.straddlers == Config::Straddlers::duplicate;
        PlacedTests<Test, Counts, Found> tests{placed_, nodes_.references, ray, counts,
                                               found,   Mailbox(remembers)};
        walk_orthtree(nodes_, config_.walk, ray, counts, [&](std::uint32_t index) {
            const OrthtreeNode& node = nodes_.nodes[index];
            return tests.in(node.first, node.count);
        });
    }
    // [search]

    OrthtreeNodes<3> nodes_;
    PlacedTriangles placed_;
    Config config_;
};

}  // namespace space
