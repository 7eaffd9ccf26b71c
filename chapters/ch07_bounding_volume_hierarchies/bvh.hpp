/// @file
/// The accelerator: a tree by any of the chapter's builders, and its triangles in the order of the
/// leaves.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_walk.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"
#include "common/parallel.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space {

/// With the exact test, and boxes with margins, its answers are those of the naive loop, bit for
/// bit, whatever builder.
///
/// run_suite and the lab's offer take templates over the triangle test alone:
/// `template <TriangleTest Test = FilteredExact> using BinnedBvh = Bvh<BinnedBuilder, Test>;`
template <class Builder, TriangleTest Test = FilteredExact, BvhWay way = BvhWay{}>
class Bvh {
  public:
    using Config = typename Builder::Config;

    /// @throws LimitError where the tree is deeper than the stack of a ray's walk
    template <class Observer = NoObserver>
    static Bvh build(std::span<const Triangle> triangles, const Config& config = {},
                     Observer&& observer = {}) {
        Bvh bvh;
        bvh.costs_ = config.costs;
        bvh.nodes_ = Builder::template build<3>(triangles, config, observer);
        if (bvh.nodes_.depth > max_bvh_depth)
            throw LimitError("bounding volume hierarchy: deeper than " +
                             std::to_string(max_bvh_depth));
        unsigned threads = 1;
        if constexpr (requires { config.threads; }) threads = config.threads;
        const auto& references = bvh.nodes_.references;
        bvh.triangles_.resize(references.size());
        parallel_for(references.size(), threads, std::size_t{1} << 14,
                     [&](std::size_t i) { bvh.triangles_[i] = triangles[references[i]]; });
        return bvh;
    }
    const BvhNodes<3>& nodes() const { return nodes_; }

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
        nodes_.for_each_node(
            [&](std::uint32_t index, unsigned) { leaves += nodes_.nodes[index].is_leaf(); });
        return {.nodes = nodes_.size(),
                .leaves = leaves,
                .depth = nodes_.depth,
                .references = nodes_.references.size(),
                .bytes = sizeof *this + nodes_.nodes.size() * sizeof(BvhNode<3>) +
                         nodes_.references.size() * (sizeof(std::uint32_t) + sizeof(Triangle)),
                .sah_cost = nodes_.sah_cost(costs_)};
    }

  private:
    // [search]
    /// Calls found(hit) for the hits of every triangle in the leaves that the ray comes to; it
    /// returns the t beyond which nothing matters any more.
    template <class Counts, class Found>
    void search(const Ray& ray, Counts& counts, const Found& found) const {
        double limit = infinity;
        walk_bvh<way>(nodes_, ray, counts, [&](const BvhNode<3>& leaf) {
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                counts.test_triangle();
                if (auto hit = Test::intersect(ray, triangles_[i])) {
                    hit->triangle = nodes_.references[i];
                    limit = found(*hit);
                }
            }
            return limit;
        });
    }
    // [search]

    BvhNodes<3> nodes_;
    /// Copies: triangles_[i] is that of nodes_.references[i].
    std::vector<Triangle, CacheLineAllocator<Triangle>> triangles_;
    BvhCosts costs_;
};

}  // namespace space
