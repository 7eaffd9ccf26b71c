/// @file
/// Rays in a tree that they make on their way: chapter 4's walk, over nodes that may wait.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/mailbox.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_nodes.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// The accelerator, watched. With the exact test its answers are those of the naive loop, bit for
/// bit, whatever others have asked before or ask at the same time. One that was never built, or has
/// been moved from, has no nodes: nothing is hit.
template <TriangleTest Test, class Observer>
class WatchedLazyKdTree {
  public:
    using Config = LazyKdTreeConfig;
    using Nodes = LazyKdNodes<3, Observer>;

    /// Only the box of all triangles is found here. The observer is told what rays do.
    static WatchedLazyKdTree build(std::span<const Triangle> triangles, const Config& config = {},
                                   Observer observer = {}) {
        WatchedLazyKdTree tree;
        tree.triangles_.assign(triangles.begin(), triangles.end());
        tree.nodes_ = std::make_unique<const Nodes>(tree.triangles_, config, std::move(observer));
        tree.costs_ = config.costs;
        tree.mailboxes_ = config.mailboxes;
        return tree;
    }
    /// Of a tree that was built.
    const Nodes& nodes() const { return *nodes_; }
    void build_all() const {
        if (nodes_) nodes_->build_all();
    }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        return nearest_found([&](const auto& found) { search(ray, counts, found); });
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        return is_any_found([&](const auto& found) { search(ray, counts, found); });
    }

    /// Of the tree as it stands, where a node that waits is a leaf. Not while rays make others.
    TreeShape shape() const {
        if (!nodes_) return {};
        const LazyKdCounts counts = nodes_->counts();
        double cost = 0.0;
        nodes_->for_each_cell([&](const typename Nodes::Cell& cell) {
            const double step = cell.state == Nodes::State::inner ? costs_.traversal : 0.0;
            const double tests = costs_.intersection * double(cell.references);
            cost += cell.box.half_area() * (step + tests);
        });
        const double whole = nodes_->box.half_area();
        return {.nodes = counts.standing() + counts.waiting,
                .leaves = counts.leaves + counts.waiting,
                .depth = counts.depth,
                .references = counts.references + counts.waiting_references,
                .bytes = sizeof *this + counts.bytes + triangles_.size() * sizeof(Triangle),
                .sah_cost = whole > 0.0 ? std::optional(cost / whole) : std::nullopt};
    }

  private:
    // [search]
    template <class Counts, class Found>
    void search(const Ray& ray, Counts& counts, const Found& found) const {
        if (!nodes_) return;
        Mailbox mailbox(mailboxes_);
        double limit = infinity;
        walk_cells(*nodes_, ray, counts, [&](std::uint32_t node) {
            const auto names = nodes_->own(node);
            const auto copies = nodes_->copies(node);
            for (std::size_t i = 0; i < names.size(); ++i) {
                if (mailbox.remembers(names[i])) continue;
                counts.test_triangle();
                if (auto hit = Test::intersect(ray, copies[i])) {
                    hit->triangle = names[i];
                    limit = found(*hit);
                }
            }
            return limit;
        });
    }
    // [search]

    std::vector<Triangle> triangles_;  ///< of which nodes are made
    std::unique_ptr<const Nodes> nodes_;
    SahCosts costs_;
    bool mailboxes_ = true;
};

/// The accelerator.
template <TriangleTest Test = FilteredExact>
using LazyKdTree = WatchedLazyKdTree<Test, NoObserver>;

}  // namespace space
