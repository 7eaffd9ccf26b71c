/// @file
/// A hierarchy that follows its triangles as they move: refitted, refitted and repaired, or built
/// anew.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_walk.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "chapters/ch09_instancing_and_motion/tree_rotations.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

// [refit_upwards]
/// The boxes of all nodes in one pass: children stand behind their parents, so from the last node
/// to the first. leaf_box(leaf) is around what a leaf names; finished(i) is told each inner node
/// whose box stands, and may change what is below it.
template <int D, class LeafBox, class Finished>
void refit_upwards(BvhNodes<D>& tree, const LeafBox& leaf_box, const Finished& finished) {
    for (auto i = static_cast<std::uint32_t>(tree.nodes.size()); i-- > 0;) {
        BvhNode<D>& node = tree.nodes[i];
        if (i == 1) continue;  // the gap is no node
        if (node.is_leaf()) {
            node.box = leaf_box(node);
        } else {
            node.box = box_of_both(tree, node.first, node.first + 1);
            finished(i);
        }
    }
}
// [refit_upwards]

/// A tree by any builder of chapter 7, whose triangles may move. Whatever is done to it, its
/// answers are those of the naive loop over the triangles as they are, bit for bit.
template <class Builder = BinnedBuilder, TriangleTest Test = FilteredExact>
class RefittedBvh {
  public:
    using Config = typename Builder::Config;

    /// @throws LimitError where the tree is deeper than the stack of a ray's walk
    static RefittedBvh build(std::span<const Triangle> triangles, const Config& config = {}) {
        RefittedBvh bvh;
        bvh.config_ = config;
        bvh.rebuild(triangles);
        return bvh;
    }
    const BvhNodes<3>& nodes() const { return nodes_; }

    // [follow]
    /// The same triangles, elsewhere: a new tree.
    void rebuild(std::span<const Triangle> moved) {
        nodes_ = Builder::template build<3>(moved, config_);
        if (nodes_.depth > max_bvh_depth)
            throw LimitError("bounding volume hierarchy: deeper than " +
                             std::to_string(max_bvh_depth));
        triangles_.resize(nodes_.references.size());
        fetch(moved);
        note_left_out(moved);
    }

    /// The same tree around them.
    void refit(std::span<const Triangle> moved) {
        if (!is_complete(moved)) return rebuild(moved);
        fetch(moved);
        refit_upwards(
            nodes_, [&](const auto& leaf) { return box_of(leaf); }, [](std::uint32_t) {});
    }

    /// The same, with rotations where they save something: each inner node is asked once, after all
    /// that is below it. Returns how many there were. A tree that has become too deep is built
    /// anew.
    std::size_t refit_and_rotate(std::span<const Triangle> moved,
                                 unsigned max_depth = max_bvh_depth) {
        if (!is_complete(moved)) return rebuild(moved), 0;
        fetch(moved);
        std::size_t rotations = 0;
        refit_upwards(
            nodes_, [&](const auto& leaf) { return box_of(leaf); },
            [&](std::uint32_t node) { rotations += rotate_below(nodes_, node); });
        if (rotations > 0) put_parents_first(nodes_);
        if (nodes_.depth > max_depth) rebuild(moved);
        return rotations;
    }
    // [follow]

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
                         nodes_.references.size() * (sizeof(std::uint32_t) + sizeof(Triangle)) +
                         left_out_.size() * sizeof(std::uint32_t),
                .sah_cost = nodes_.sah_cost(config_.costs)};
    }

  private:
    // [fetch]
    /// Triangles from where they are now, in the order of the leaves. In a loop of its own: reads
    /// from all over memory do not depend on each other, so many are under way at once, as long as
    /// nothing else stands between them.
    void fetch(std::span<const Triangle> moved) {
        for (std::size_t i = 0; i < triangles_.size(); ++i)
            triangles_[i] = moved[nodes_.references[i]];
    }
    // [fetch]
    Aabb box_of(const BvhNode<3>& leaf) const {
        Aabb box;
        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
            box.extend(box_if_finite<3>(triangles_[i]));
        return box;
    }

    /// Triangles that were not finite when the tree was built are not in it.
    void note_left_out(std::span<const Triangle> triangles) {
        left_out_.clear();
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            if (box_if_finite<3>(triangles[i]).is_empty()) left_out_.push_back(i);
    }
    bool is_complete(std::span<const Triangle> moved) const {
        return std::ranges::all_of(
            left_out_, [&](std::uint32_t i) { return box_if_finite<3>(moved[i]).is_empty(); });
    }

    template <class Counts, class Found>
    void search(const Ray& ray, Counts& counts, const Found& found) const {
        double limit = infinity;
        walk_bvh(nodes_, ray, counts, [&](const BvhNode<3>& leaf) {
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

    Config config_;
    BvhNodes<3> nodes_;
    /// Copies: triangles_[i] is that of nodes_.references[i].
    std::vector<Triangle, CacheLineAllocator<Triangle>> triangles_;
    std::vector<std::uint32_t> left_out_;  ///< in no leaf
};

}  // namespace space
