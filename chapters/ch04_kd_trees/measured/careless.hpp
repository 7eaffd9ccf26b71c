/// @file
/// How k-d trees are built and walked with less care than the chapter's, to count what is lost.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space::ch04 {

// [walk_in_float]
/// walk_cells with distances in float and without margins, as in many programs.
struct WalkInFloat {
    template <class Own>
    void operator()(const KdNodes<3>& tree, const Ray& ray, const Own& own) const {
        struct Waiting {
            std::uint32_t node;
            float enter, leave;
        };
        const Vector3 inverse = 1.0f / ray.direction;
        float enter = ray.tmin, leave = ray.tmax;
        for (int axis = 0; axis < 3; ++axis) {
            float first = (tree.box.min[axis] - ray.origin[axis]) * inverse[axis],
                  last = (tree.box.max[axis] - ray.origin[axis]) * inverse[axis];
            if (first > last) std::swap(first, last);
            enter = std::max(enter, first);
            leave = std::min(leave, last);
        }
        if (enter > leave) return;
        std::array<Waiting, max_kd_depth> waiting;
        std::size_t size = 0;
        for (std::uint32_t index = 0;;) {
            while (!tree.nodes[index].is_leaf()) {
                const KdNode node = tree.nodes[index];
                const float origin = ray.origin[node.axis()], plane = node.position();
                const float t = (plane - origin) * inverse[node.axis()];
                const bool above =
                    origin > plane || (origin == plane && ray.direction[node.axis()] > 0.0f);
                const std::uint32_t near = node.below() + above;
                if (t < enter && t > 0.0f) {
                    index = near ^ 1;
                    continue;
                }
                index = near;
                if (t > leave || t <= 0.0f) continue;
                waiting[size++] = {near ^ 1, t, leave};
                leave = t;
            }
            const double limit = own(index);
            if (size == 0 || limit < waiting[size - 1].enter) return;
            index = waiting[--size].node;
            enter = waiting[size].enter;
            leave = waiting[size].leave;
        }
    }
};
// [walk_in_float]

/// The chapter's own.
struct WalkWithMargins {
    template <class Own>
    void operator()(const KdNodes<3>& tree, const Ray& ray, const Own& own) const {
        NoCounts counts;
        walk_cells(tree, ray, counts, own);
    }
};

/// The nearest hit by a walk; no mailbox. With `first_leaf` what the first leaf with a hit has.
template <class Walk, class Counts = NoCounts>
std::optional<Hit> nearest_by(const Walk& walk, const KdNodes<3>& tree,
                              std::span<const Triangle> triangles, const Ray& ray,
                              Counts&& counts = {}, bool first_leaf = false) {
    std::optional<Hit> nearest;
    walk(tree, ray, [&](std::uint32_t node) -> double {
        for (const std::uint32_t i : tree.own(node)) {
            counts.test_triangle();
            auto hit = FilteredExact::intersect(ray, triangles[i]);
            if (!hit) continue;
            hit->triangle = i;
            if (!nearest || nearer(*hit, *nearest)) nearest = hit;
        }
        if (!nearest) return infinity;
        return first_leaf ? std::nan("") : double{std::nextafter(nearest->t, infinity)};
    });
    return nearest;
}

/// The same cells with other references: `part(triangle, box, cell)` is the box of a triangle's
/// part in a cell, where `box` is that of its part in the parent, cut off at the cell; empty where
/// the cell is not to name it. What only touches a plane goes to one side, as the builder has it.
template <class Part>
class SortedAnew {
  public:
    SortedAnew(KdNodes<3> tree, std::span<const Triangle> triangles, const Part& part)
        : tree_(std::move(tree)), triangles_(triangles), part_(part) {
        tree_.references.clear();
        std::vector<Reference> all;
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            all.push_back({i, bounds(triangles[i])});
        sort(0, tree_.box, all);
    }
    const KdNodes<3>& tree() const { return tree_; }

  private:
    struct Reference {
        std::uint32_t triangle;
        Aabb box;
    };

    void sort(std::uint32_t index, const Aabb& cell, std::span<const Reference> references) {
        const KdNode node = tree_.nodes[index];
        if (node.is_leaf()) {
            tree_.nodes[index] = KdNode::leaf(static_cast<std::uint32_t>(tree_.references.size()),
                                              static_cast<std::uint32_t>(references.size()));
            for (const Reference& reference : references)
                tree_.references.push_back(reference.triangle);
            return;
        }
        const int axis = node.axis();
        const auto [below, above] = halves(cell, {axis, node.position()});
        std::vector<Reference> in_below, in_above;
        for (const Reference& reference : references) {
            if (reference.box.max[axis] <= node.position())
                in_below.push_back(reference);
            else if (reference.box.min[axis] >= node.position())
                in_above.push_back(reference);
            else {
                add(in_below, reference, below);
                add(in_above, reference, above);
            }
        }
        sort(node.below(), below, in_below);
        sort(node.below() + 1, above, in_above);
    }
    void add(std::vector<Reference>& side, const Reference& reference, const Aabb& cell) const {
        const Aabb box{glm::max(reference.box.min, cell.min),
                       glm::min(reference.box.max, cell.max)};
        const Aabb part = part_(triangles_[reference.triangle], box, cell);
        if (!part.is_empty()) side.push_back({reference.triangle, part});
    }

    KdNodes<3> tree_;
    std::span<const Triangle> triangles_;
    Part part_;
};

}  // namespace space::ch04
