/// @file
/// Rays in a BSP tree: front to back, both subtrees only where the ray crosses the plane.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "common/accelerator.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace space {

/// Where a ray crosses a plane: t lies in [earliest, latest]; anywhere if it runs (nearly) along
/// the plane.
struct PlaneCrossing {
    bool starts_in_front;
    double earliest, latest;
};

// [cross_plane]
/// Of height over the plane and slope along the ray half the error is spare: t = -height / slope is
/// off by at most (height.error + |t| slope.error) / |slope|, where |slope| > 2 slope.error, and a
/// third of this pays for the roundings of t, of the error and of their sum. Where the slope is
/// smaller, the ray may cross anywhere, unless its whole way [enter, leave] stays clear of the
/// plane.
template <int D>
PlaneCrossing cross_plane(const BasicRay<D>& ray, const SplitPlane<D>& plane, double enter,
                          double leave) {
    const Estimate height =
        along_normal(plane, Double<D>(ray.origin) - Double<D>(plane.through[0]));
    const Estimate slope = along_normal(plane, Double<D>(ray.direction));
    if (std::abs(slope.value) > 2.0 * slope.error) {
        const double t = -height.value / slope.value;
        const double error = (height.error + std::abs(t) * slope.error) / std::abs(slope.value);
        return {slope.value < 0.0, t - error, t + error};
    }
    const double way = std::max(std::abs(enter), std::abs(leave));
    if (std::abs(height.value) > height.error + way * (std::abs(slope.value) + slope.error))
        return {height.value > 0.0, infinity, infinity};  // never
    return {height.value > 0.0, -infinity, infinity};
}
// [cross_plane]

/// Events of a ray's walk through a tree.
struct BspWalk {
    /// The ray is in a node's cell from t = enter to t = leave, and this is how it meets the plane.
    struct Visited {
        std::uint32_t node;
        double enter, leave;
        PlaneCrossing crossing;
    };
    /// It has come to the plane of a node, what lies there has been tested, and it goes on behind
    /// the plane.
    struct Crossed {
        std::uint32_t node;
        double enter, leave;
    };
    /// The plane of a node and what is behind it: farther than what has been hit.
    struct Dropped {
        std::uint32_t node;
        double enter, leave;
    };
};

// [front_to_back]
/// Walks the cells along the ray, from its origin on, and calls cross(node) for every node whose
/// plane the ray crosses within the node's cell: after all that lies before the plane, before all
/// that lies behind it. cross returns the t beyond which nothing matters any more (NaN: nothing at
/// all). The stack is our own: a tree may be deeper than the machine's stack.
template <int D, class Counts, class Cross, class Observer = NoObserver>
void front_to_back(const BspTree<D>& tree, const BasicRay<D>& ray, Counts& counts,
                   const Cross& cross, Observer&& observer = {}) {
    if (!is_valid(ray) || tree.nodes.empty()) return;
    struct Task {
        std::uint32_t crossed;  ///< the node whose plane comes next; none before the first
        std::uint32_t cell;     ///< the child beyond it
        double enter, leave;    ///< the part of the ray in that child, never too short
    };
    // What counts is t rounded to float: a hit may lie half a place outside the interval.
    std::vector<Task> tasks{{BspTree<D>::none, 0, std::nextafter(ray.tmin, -infinity),
                             std::nextafter(ray.tmax, infinity)}};
    double limit = infinity;
    while (!tasks.empty()) {
        auto [crossed, index, enter, leave] = tasks.back();
        tasks.pop_back();
        if (!(enter <= limit)) {
            observer.observe(BspWalk::Dropped{crossed, enter, leave});
            continue;
        }
        if (crossed != BspTree<D>::none) {
            limit = cross(tree.nodes[crossed]);
            observer.observe(BspWalk::Crossed{crossed, enter, leave});
        }
        while (index != BspTree<D>::none) {
            const auto& node = tree.nodes[index];
            counts.visit_node();
            const PlaneCrossing crossing = cross_plane(ray, tree.planes[node.plane], enter, leave);
            observer.observe(BspWalk::Visited{index, enter, leave, crossing});
            const std::uint32_t near = crossing.starts_in_front ? node.front : node.back;
            const std::uint32_t far = crossing.starts_in_front ? node.back : node.front;
            if (crossing.latest < enter) {
                index = far;
            } else if (crossing.earliest > leave) {
                index = near;
            } else {
                tasks.push_back({index, far, std::max(enter, crossing.earliest), leave});
                index = near;
                leave = std::min(leave, crossing.latest);
            }
        }
    }
}
// [front_to_back]

/// The accelerator. A fragment stands for its original triangle, which is the one that is tested:
/// fragments give the order only, and their rounded corners never decide a hit. In the exact grade
/// and with the exact test its answers are those of the naive loop, bit for bit; a test that hits
/// outside of the triangle or misplaces t may hit where no node is searched for it.
template <TriangleTest Test = FilteredExact>
class Bsp {
  public:
    using Config = BspConfig;

    template <class Observer = NoObserver>
    static Bsp build(std::span<const Triangle> triangles, const Config& config = {},
                     Observer&& observer = {}) {
        Bsp bsp;
        bsp.tree_ = BspBuilder<3>::build(triangles, config, observer);
        return bsp;
    }
    const BspTree<3>& tree() const { return tree_; }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        return nearest_found([&](const auto& found) { traverse(ray, counts, found); });
    }

    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        return is_any_found([&](const auto& found) { traverse(ray, counts, found); });
    }

    TreeShape shape() const {
        std::size_t bytes = sizeof *this + tree_.nodes.size() * sizeof(BspTree<3>::Node) +
                            tree_.planes.size() * sizeof(SplitPlane<3>) +
                            tree_.polygons.size() * sizeof(Triangle);
        std::size_t leaves = 0;
        for (const Fragment<3>& fragment : tree_.fragments)
            bytes += sizeof fragment + fragment.corners.size() * sizeof(Fragment<3>::Corner);
        for (const auto& node : tree_.nodes)
            leaves += node.front == BspTree<3>::none && node.back == BspTree<3>::none;
        return {.nodes = tree_.nodes.size(),
                .leaves = leaves,
                .depth = tree_.depth(),
                .references = tree_.fragments.size(),
                .bytes = bytes};
    }

  private:
    // [traverse]
    /// Calls found(hit) for the hits of every triangle that has a fragment where the ray crosses
    /// its plane; found returns the t beyond which nothing matters any more.
    template <class Counts, class Found>
    void traverse(const Ray& ray, Counts& counts, const Found& found) const {
        double limit = infinity;
        front_to_back(tree_, ray, counts, [&](const BspTree<3>::Node& node) {
            for (std::uint32_t i = 0; i < node.count; ++i) {
                const std::uint32_t polygon = tree_.fragments[node.first + i].polygon;
                counts.test_triangle();
                if (auto hit = Test::intersect(ray, tree_.polygons[polygon])) {
                    hit->triangle = polygon;
                    limit = found(*hit);
                }
            }
            return limit;
        });
    }
    // [traverse]

    BspTree<3> tree_;
};

}  // namespace space
