/// @file
/// The smallest tree that passes the suite, and the same with faults of traversal: what the suite
/// itself is tested with. (How to build a good one is the matter of chapter 7.)
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "common/accelerator.hpp"
#include "tests/suite/tree_check.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace space {

/// What is left out of a correct traversal.
enum class TreeFlaw {
    none,
    box_equals_pruned,  ///< a box that begins at the best t is skipped: ties are lost
    first_leaf_wins,    ///< stops at the first leaf with a hit
    nan_box_test,       ///< 0 * infinity on a box's face rejects the box
    vertices_only,      ///< boxes of a triangle's first two vertices
};

template <TreeFlaw flaw = TreeFlaw::none>
class SmallBvh {
  public:
    static SmallBvh build(std::span<const Triangle> triangles) {
        SmallBvh tree;
        tree.triangles_.assign(triangles.begin(), triangles.end());
        std::vector<std::uint32_t> ids(triangles.size());
        std::iota(ids.begin(), ids.end(), 0u);
        if (!ids.empty()) tree.add_node(ids);
        return tree;
    }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        std::optional<Hit> best;
        if (is_valid(ray) && !nodes_.empty()) visit(0, ray, counts, best, false);
        return best;
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        std::optional<Hit> best;
        if (is_valid(ray) && !nodes_.empty()) visit(0, ray, counts, best, true);
        return best.has_value();
    }

    TreeShape shape() const {
        if (nodes_.empty()) return {.nodes = 0, .leaves = 0, .depth = 0, .bytes = sizeof *this};
        const auto leaves = static_cast<std::size_t>(
            std::count_if(nodes_.begin(), nodes_.end(),
                          [](const TreeNode& node) { return node.children.empty(); }));
        return {.nodes = nodes_.size(),
                .leaves = leaves,
                .depth = depth(0),
                .references = triangles_.size(),
                .bytes = sizeof *this + nodes_.size() * sizeof(TreeNode) +
                         triangles_.size() * sizeof(Triangle)};
    }
    std::span<const TreeNode> nodes() const { return nodes_; }

  private:
    std::uint32_t add_node(std::span<std::uint32_t> ids) {
        constexpr std::size_t max_leaf_size = 4;
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        Aabb box, middles;
        for (const std::uint32_t id : ids) {
            const Triangle& t = triangles_[id];
            box.extend(flaw == TreeFlaw::vertices_only ? bounds({t.a, t.b, t.b}) : bounds(t));
            middles.extend(bounds(t).centroid());
        }
        nodes_[index].box = box;
        if (ids.size() <= max_leaf_size) {
            nodes_[index].triangles.assign(ids.begin(), ids.end());
            return index;
        }
        const int axis = middles.longest_axis();
        const auto key = [&](std::uint32_t id) {
            return std::pair(bounds(triangles_[id]).centroid()[axis], id);
        };
        std::sort(ids.begin(), ids.end(),
                  [&](std::uint32_t x, std::uint32_t y) { return key(x) < key(y); });
        const std::uint32_t left = add_node(ids.first(ids.size() / 2)),
                            right = add_node(ids.subspan(ids.size() / 2));
        nodes_[index].children = {left, right};
        return index;
    }

    /// Where the ray enters the box, in double, or infinity. The box is made larger by 10^-6 of its
    /// coordinates and t is taken 10^-6 earlier: more than a float's rounding of t, or double's in
    /// the triangle test, can amount to.
    static double entry(const Aabb& box, const Ray& ray) {
        double from = ray.tmin, to = ray.tmax;
        for (int axis = 0; axis < 3; ++axis) {
            const double slack =
                1e-6 * std::max(std::abs(double{box.min[axis]}), std::abs(double{box.max[axis]}));
            const double inverse = 1.0 / double{ray.direction[axis]}, origin = ray.origin[axis];
            double near = (box.min[axis] - slack - origin) * inverse,
                   far = (box.max[axis] + slack - origin) * inverse;
            if (flaw == TreeFlaw::nan_box_test) {
                near = (box.min[axis] - origin) * inverse, far = (box.max[axis] - origin) * inverse;
                if (!(std::min(near, far) <= to && std::max(near, far) >= from)) return infinity;
            }
            if (std::signbit(inverse)) std::swap(near, far);
            from = near > from
                       ? near
                       : from;  // not a number: the origin lies on the slab's plane, no limit
            to = far < to ? far : to;
        }
        const double early = from - 1e-6 * std::abs(from);
        return early <= to + 1e-6 * std::abs(to) ? (std::isnan(early) ? from : early) : infinity;
    }

    template <class Counts>
    void visit(std::uint32_t index, const Ray& ray, Counts& counts, std::optional<Hit>& best,
               bool any) const {
        const TreeNode& node = nodes_[index];
        const double enters = entry(node.box, ray);
        if (std::isinf(enters) && enters > 0) return;
        if (best && (any || enters > best->t || (flaw == TreeFlaw::first_leaf_wins) ||
                     (flaw == TreeFlaw::box_equals_pruned && enters * (1 + 1e-5) >= best->t)))
            return;
        counts.visit_node();
        for (const std::uint32_t id : node.triangles) {
            counts.test_triangle();
            if (std::optional<Hit> hit = FilteredExact::intersect(ray, triangles_[id])) {
                hit->triangle = id;
                if (!best || nearer(*hit, *best)) best = hit;
            }
        }
        for (const std::uint32_t child : node.children) visit(child, ray, counts, best, any);
    }

    std::size_t depth(std::uint32_t index) const {
        std::size_t deepest = 0;
        for (const std::uint32_t child : nodes_[index].children)
            deepest = std::max(deepest, 1 + depth(child));
        return deepest;
    }

    std::vector<Triangle> triangles_;
    std::vector<TreeNode> nodes_;
};

}  // namespace space
