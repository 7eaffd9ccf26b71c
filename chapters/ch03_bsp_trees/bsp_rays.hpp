/// @file
/// Rays in a BSP tree of triangles: front to back, both subtrees only where the ray crosses the plane.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch03_bsp_trees/bsp_build.hpp"
#include "common/accelerator.hpp"

namespace space {

/// The accelerator. A fragment stands for its original triangle, which is the one that is tested: fragments give the order
/// only, and their rounded corners never decide a hit.
template <TriangleTest Test = MollerTrumbore>
class Bsp {
  public:
    using Config = BspConfig;

    static Bsp build(std::span<const Triangle> triangles, const Config& config = {}) {
        std::vector<Corners<3>> polygons;
        for (const Triangle& triangle : triangles) polygons.push_back(corners(triangle));
        Bsp bsp;
        bsp.tree_ = BspBuilder<3>::build(polygons, config);
        return bsp;
    }
    const BspTree<3>& tree() const { return tree_; }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        std::optional<Hit> nearest;
        traverse(ray, counts, [&](const Hit& hit) {
            if (!nearest || nearer(hit, *nearest)) nearest = hit;
            // A hit half a place farther may round to the same t and have the smaller index.
            return double{std::nextafter(nearest->t, infinity)};
        });
        return nearest;
    }

    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        bool found = false;
        traverse(ray, counts, [&](const Hit&) {
            found = true;
            return std::nan("");  // nothing is nearer than this, and nothing matters any more
        });
        return found;
    }

    TreeShape shape() const {
        std::size_t bytes = sizeof *this + tree_.nodes.size() * sizeof(BspTree<3>::Node) +
                            tree_.planes.size() * sizeof(SplitPlane<3>) + tree_.polygons.size() * sizeof(Corners<3>);
        std::size_t leaves = 0;
        for (const Fragment<3>& fragment : tree_.fragments)
            bytes += sizeof fragment + fragment.corners.size() * sizeof(Corner<3>);
        for (const auto& node : tree_.nodes) leaves += node.front == BspTree<3>::none && node.back == BspTree<3>::none;
        return {.nodes = tree_.nodes.size(), .leaves = leaves, .depth = tree_.depth(), .references = tree_.fragments.size(), .bytes = bytes};
    }

  private:
    // [traverse]
    /// Calls found(hit) for the hits of every triangle that has a fragment on the ray's way; found returns the t beyond
    /// which nothing matters any more.
    template <class Counts, class Found>
    void traverse(const Ray& ray, Counts& counts, const Found& found) const {
        if (!is_valid(ray) || tree_.nodes.empty()) return;
        struct Task {
            std::int32_t node;
            double enter, leave;  ///< the part of the ray in the node's cell, never too short
        };
        // What counts is t rounded to float: a hit may lie half a place outside the interval.
        std::vector<Task> tasks{{0, std::nextafter(ray.tmin, -infinity), std::nextafter(ray.tmax, infinity)}};
        double limit = infinity;
        while (!tasks.empty()) {
            auto [index, enter, leave] = tasks.back();
            tasks.pop_back();
            while (index != BspTree<3>::none && enter <= limit) {
                const auto& node = tree_.nodes[static_cast<std::size_t>(index)];
                counts.visit_node();
                const Crossing crossing = cross_plane(ray, tree_.planes[node.plane], enter, leave);
                // The child on the origin's side comes first.
                const std::int32_t near = crossing.starts_in_front ? node.front : node.back;
                const std::int32_t far = crossing.starts_in_front ? node.back : node.front;
                const bool near_only = crossing.earliest > leave, far_only = crossing.latest < enter;
                if (!near_only && !far_only)
                    for (std::uint32_t i = 0; i < node.count; ++i) {
                        const std::uint32_t polygon = tree_.fragments[node.first + i].polygon;
                        const Corners<3>& p = tree_.polygons[polygon];
                        counts.test_triangle();
                        if (auto hit = Test::intersect(ray, Triangle{p[0], p[1], p[2]})) {
                            hit->triangle = polygon;
                            limit = found(*hit);
                        }
                    }
                if (far_only) {
                    index = far;
                } else if (near_only) {
                    index = near;
                } else {
                    if (far != BspTree<3>::none) tasks.push_back({far, std::max(enter, crossing.earliest), leave});
                    index = near;
                    leave = std::min(leave, crossing.latest);
                }
            }
        }
    }
    // [traverse]

    /// Where the ray crosses a plane: t lies in [earliest, latest]; everything if it runs (nearly) along the plane.
    struct Crossing {
        bool starts_in_front;
        double earliest, latest;
    };

    // [cross_plane]
    /// Height over the plane and slope along the ray are known to within errors like side_filter's; t = -height / slope to
    /// within (height_error + |t| slope_error) / (|slope| - slope_error). Where the slope's sign is not known, the ray may
    /// cross anywhere, unless its whole way [enter, leave] stays clear of the plane.
    static Crossing cross_plane(const Ray& ray, const SplitPlane<3>& plane, double enter, double leave) {
        constexpr double roundings = 16.0 * 0x1p-53;
        const Double3 from = Double3(ray.origin) - Double3(plane.through[0]), direction{ray.direction};
        const double height = glm::dot(plane.normal, from), slope = glm::dot(plane.normal, direction);
        const double height_error = roundings * plane.size * SplitPlane<3>::one_norm(from);
        const double slope_error = roundings * plane.size * SplitPlane<3>::one_norm(direction);
        if (std::abs(slope) > 2.0 * slope_error) {
            const double t = -height / slope;
            const double error = (height_error + std::abs(t) * slope_error) / (std::abs(slope) - slope_error);
            return {slope < 0.0, t - error, t + error};
        }
        const double reach = std::max(std::abs(enter), std::abs(leave)) * (std::abs(slope) + slope_error);
        if (std::abs(height) > height_error + reach) return {height > 0.0, infinity, infinity};  // never
        return {height > 0.0, -infinity, infinity};
    }
    // [cross_plane]

    BspTree<3> tree_;
};

}  // namespace space
