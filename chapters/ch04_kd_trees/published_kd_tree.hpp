/// @file
/// The k-d tree of Lichter23 (section 3) as it is published, and a switch for the cure of each of
/// its faults.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "common/accelerator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// The cures, one by one; without any the tree is the published one.
struct PublishedKdTreeConfig {
    std::size_t max_leaf_size = 8;  ///< MAX_TRIANGLES_PER_LEAF, whose value is not published
    /// The root's box holds every corner. As published it starts from the x of the first corner on
    /// all three axes, and from the second triangle on.
    bool whole_scene_box = false;
    /// A triangle belongs to a half that its bounding box overlaps. As published: to one that holds
    /// a corner.
    bool sort_by_overlap = false;
    /// The box test is SlabConservative. As published it loses rays to 0 / 0 and to rounding.
    bool safe_box_test = false;
    /// The child where the ray comes from is visited first. As published: always the left one.
    bool near_child_first = false;
    /// Only what lies within the ray's interval and before the nearest hit so far is visited. As
    /// published: also what lies behind the eye or the hit.
    bool early_end = false;

    static PublishedKdTreeConfig cured() {
        return {.whole_scene_box = true,
                .sort_by_overlap = true,
                .safe_box_test = true,
                .near_child_first = true,
                .early_end = true};
    }
};

/// The longest axis is cut in the middle; what lies in both halves stays in the inner node.
template <TriangleTest Test = FilteredExact>
class PublishedKdTree {
  public:
    using Config = PublishedKdTreeConfig;
    static constexpr std::uint32_t none = ~0u;  ///< no node

    /// A node's own triangles are those of a leaf, or of an inner node those in both halves.
    struct Node {
        Aabb box;
        std::uint32_t left = none, right = none;
        std::uint32_t first = 0, count = 0;  ///< own triangles, in references()
        int axis = 0;                        ///< of an inner node's cut
    };

    static PublishedKdTree build(std::span<const Triangle> triangles, const Config& config = {}) {
        PublishedKdTree tree;
        tree.config_ = config;
        tree.triangles_.assign(triangles.begin(), triangles.end());
        if (triangles.empty()) return tree;
        std::vector<std::uint32_t> all(triangles.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        tree.build_node(tree.scene_box(), all);
        return tree;
    }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        std::optional<Hit> nearest;
        search(ray, counts, [&](const Hit& hit) {
            if (!nearest || nearer(hit, *nearest)) nearest = hit;
            return nearest->t;
        });
        return nearest;
    }

    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        bool found = false;
        search(ray, counts, [&](const Hit& hit) {
            found = true;
            return config_.early_end ? std::nanf("") : hit.t;  // NaN: nothing matters any more
        });
        return found;
    }

    TreeShape shape() const {
        std::size_t leaves = 0;
        std::vector<std::size_t> level(nodes_.size());
        std::size_t deepest = 0;
        for (std::size_t i = 0; i < nodes_.size(); ++i) {  // parents stand before their children
            leaves += nodes_[i].left == none;
            deepest = std::max(deepest, level[i]);
            if (nodes_[i].left == none) continue;
            level[nodes_[i].left] = level[nodes_[i].right] = level[i] + 1;
        }
        return {.nodes = nodes_.size(),
                .leaves = leaves,
                .depth = deepest,
                .references = references_.size(),
                .bytes = sizeof *this + nodes_.size() * sizeof(Node) +
                         references_.size() * sizeof(std::uint32_t) +
                         triangles_.size() * sizeof(Triangle)};
    }

    std::span<const Node> nodes() const { return nodes_; }  ///< the root first
    std::span<const std::uint32_t> references() const { return references_; }
    std::span<const Triangle> triangles() const { return triangles_; }

  private:
    // [scene_box]
    Aabb scene_box() const {
        const float x = triangles_[0].a.x;
        Aabb box{Point3(x), Point3(x)};
        if (config_.whole_scene_box) box = bounds(triangles_[0]);
        for (std::size_t i = 1; i < triangles_.size(); ++i) box.extend(bounds(triangles_[i]));
        return box;
    }
    // [scene_box]

    /// The two halves of the longest axis.
    static std::pair<Aabb, Aabb> halves(const Aabb& box, int axis) {
        Aabb left = box, right = box;
        left.max[axis] = right.min[axis] = std::midpoint(box.min[axis], box.max[axis]);
        return {left, right};
    }

    // [belongs]
    bool belongs(const Triangle& triangle, const Aabb& box) const {
        if (!config_.sort_by_overlap)
            return box.contains(triangle.a) || box.contains(triangle.b) || box.contains(triangle.c);
        const Aabb own = bounds(triangle);
        for (int axis = 0; axis < 3; ++axis)
            if (own.max[axis] < box.min[axis] || own.min[axis] > box.max[axis]) return false;
        return true;
    }
    // [belongs]

    // [build_node]
    std::uint32_t build_node(const Aabb& box, std::span<const std::uint32_t> set) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        const int axis = box.longest_axis();
        nodes_.push_back({.box = box, .axis = axis});
        std::vector<std::uint32_t> in_left, in_right, own;
        const auto [left, right] = halves(box, axis);
        // Between neighbouring floats there is no middle; as published that never ends.
        if (set.size() <= config_.max_leaf_size || left == box || right == box) {
            own.assign(set.begin(), set.end());
        } else {
            for (const std::uint32_t i : set) {
                const bool is_left = belongs(triangles_[i], left),
                           is_right = belongs(triangles_[i], right);
                if (is_left && is_right)
                    own.push_back(i);
                else if (is_left)
                    in_left.push_back(i);
                else if (is_right)
                    in_right.push_back(i);
                // In neither: the triangle is gone. That happens outside of the root's box only.
            }
            const std::uint32_t left_node = build_node(left, in_left),
                                right_node = build_node(right, in_right);
            nodes_[index].left = left_node;
            nodes_[index].right = right_node;
        }
        nodes_[index].first = static_cast<std::uint32_t>(references_.size());
        nodes_[index].count = static_cast<std::uint32_t>(own.size());
        references_.insert(references_.end(), own.begin(), own.end());
        return index;
    }
    // [build_node]

    /// Calls found(hit) for each hit that is met; it returns the t beyond which nothing matters.
    template <class Counts, class Found>
    void search(const Ray& ray, Counts& counts, const Found& found) const {
        if (!is_valid(ray) || nodes_.empty()) return;
        float limit = ray.tmax;
        visit(0, ray, limit, counts, found);
    }

    /// Whether the ray meets the box: as published its whole line, and whatever lies before.
    bool meets(Ray ray, const Aabb& box, float limit) const {
        if (!config_.early_end) {
            ray.tmin = -infinity;
            ray.tmax = infinity;
        } else {
            // What counts is t rounded to float: a hit may lie half a place outside.
            ray.tmin = std::nextafter(ray.tmin, -infinity);
            ray.tmax = std::nextafter(limit, infinity);
        }
        return config_.safe_box_test ? SlabConservative::intersect(ray, box).has_value()
                                     : SlabMinMax::intersect(ray, box).has_value();
    }

    // [visit]
    template <class Counts, class Found>
    void visit(std::uint32_t index, const Ray& ray, float& limit, Counts& counts,
               const Found& found) const {
        const Node& node = nodes_[index];
        if (std::isnan(limit)) return;
        counts.visit_node();
        if (!meets(ray, node.box, limit)) return;
        if (node.left != none) {
            const bool right_first = config_.near_child_first && ray.direction[node.axis] < 0.0f;
            visit(right_first ? node.right : node.left, ray, limit, counts, found);
            visit(right_first ? node.left : node.right, ray, limit, counts, found);
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (std::isnan(limit)) return;
            counts.test_triangle();
            if (auto hit = Test::intersect(ray, triangles_[references_[i]])) {
                hit->triangle = references_[i];
                limit = found(*hit);
            }
        }
    }
    // [visit]

    Config config_;
    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> references_;
};

}  // namespace space
