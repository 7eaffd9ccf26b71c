/// @file
/// Rays in a k-d tree: front to back, both halves only where the ray may meet the plane within the
/// cell.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch04_kd_trees/kd_builder.hpp"
#include "chapters/ch04_kd_trees/kd_config.hpp"
#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "chapters/ch04_kd_trees/mailbox.hpp"
#include "chapters/ch04_kd_trees/placed_triangles.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace space {

// [kd_ray]
/// What the walk needs of a ray, once for all nodes.
template <int D>
struct KdRay {
    Double<D> origin, inverse;         ///< 1 / direction; +-infinity for +-0
    std::array<std::uint32_t, D> far;  ///< by axis, which half the ray comes to last

    explicit KdRay(const BasicRay<D>& ray)
        : origin(ray.origin), inverse(1.0 / Double<D>(ray.direction)) {
        for (int axis = 0; axis < D; ++axis)
            far[static_cast<std::size_t>(axis)] = std::signbit(ray.direction[axis]) ? 0 : 1;
    }

    /// The ray's t on a plane across an axis. Three roundings, of the difference, of the reciprocal
    /// and of the product, in double, where floats can't make them over- or underflow: off by at
    /// most gamma(3) |t|, and of the right sign. Along the plane it is +-infinity, as if the plane
    /// stood before or behind all of the ray; within the plane it is not a number.
    double distance(int axis, double position) const {
        return (position - origin[axis]) * inverse[axis];
    }
};

/// The part [enter, leave] of a ray: not less than what lies in a cell, in exact arithmetic.
///
/// With u53 = 2^-53 let t be a computed distance and T the exact one: |t - T| <= gamma(3) |T|. An
/// end that a plane makes is set 8 u53 |t| farther out, which is exact, with one rounding of the
/// sum: all in all beyond T by more than 3 u53 |T| and the terms with u53^2. So where another
/// plane's computed distance lies outside of the end, by any amount, its exact distance lies
/// outside of T, and the comparison needs no margin of its own. (7 u53 would leave nothing for the
/// terms with u53^2.)
struct RayPart {
    double enter, leave;

    /// What counts is t rounded to float: a hit may lie half a place outside of the ray's interval.
    template <int D>
    static RayPart all_of(const BasicRay<D>& ray) {
        return {std::max<double>(std::nextafter(ray.tmin, -infinity), -largest),
                std::min<double>(std::nextafter(ray.tmax, infinity), largest)};
    }

    /// Where t is not a number, all of the part stays.
    void begin_at(double t) { enter = std::max(enter, t - margin * std::abs(t)); }
    void end_at(double t) { leave = std::min(leave, t + margin * std::abs(t)); }

    static constexpr double margin = 8.0 * 0x1p-53;
    /// Finite, so that an infinite distance lies outside.
    static constexpr double largest = std::numeric_limits<double>::max();
};
// [kd_ray]

/// What of a ray's part lies in a box, if anything does. A margin keeps the order of distances: the
/// farthest plane that the ray enters by makes the farthest end. A distance that is not a number,
/// of a ray within a face, changes nothing.
template <int D>
std::optional<RayPart> part_in(const BasicAabb<D>& box, const KdRay<D>& ray, RayPart part) {
    double enter = -infinity, leave = infinity;
    for (int axis = 0; axis < D; ++axis) {
        const bool upwards = ray.far[static_cast<std::size_t>(axis)] == 1;
        enter = std::max(enter, ray.distance(axis, (upwards ? box.min : box.max)[axis]));
        leave = std::min(leave, ray.distance(axis, (upwards ? box.max : box.min)[axis]));
    }
    if (leave < part.enter) return std::nullopt;
    part.end_at(leave);
    if (enter > part.leave) return std::nullopt;
    part.begin_at(enter);
    return part;
}

/// Event: the walk has come to a node, with this part of the ray in its cell.
struct KdVisit {
    std::uint32_t node;
    RayPart part;
};

// [walk]
/// Walks the cells along the ray. Calls own(node) for every leaf, and for every inner node that
/// keeps polygons; it returns the t beyond which nothing matters any more (NaN: nothing at all). A
/// hit beyond the cell in hand ends nothing: the cells between begin before it. The observer is
/// told every node (KdVisit). Nodes is KdNodes, or what has its `box`, `empty()` and `node(index)`.
template <class Nodes, int D, class Counts, class Own, class Observer = NoObserver>
void walk_cells(const Nodes& tree, const BasicRay<D>& ray, Counts& counts, const Own& own,
                Observer&& observer = {}) {
    if (!is_valid(ray) || tree.empty()) return;
    const KdRay<D> prepared(ray);
    const std::optional<RayPart> in_box = part_in(tree.box, prepared, RayPart::all_of(ray));
    if (!in_box) return;
    RayPart part = *in_box;
    std::array<KdVisit, max_kd_depth> waiting;  // far halves, one a node above the one in hand
    std::size_t size = 0;
    double limit = infinity;
    for (std::uint32_t index = 0;;) {
        for (;;) {
            const KdNode node = tree.node(index);
            counts.visit_node();
            observer.observe(KdVisit{index, part});
            if (node.is_leaf() || node.keeps()) {
                limit = own(index);
                if (node.is_leaf() || !(part.enter <= limit)) break;
            }
            const std::uint32_t far = node.below() + prepared.far[std::size_t(node.axis())];
            const double t = prepared.distance(node.axis(), node.position());
            if (t < part.enter) {
                index = far;
                continue;
            }
            index = far ^ 1;
            if (t > part.leave) continue;
            waiting[size] = {far, part};
            waiting[size++].part.begin_at(t);
            part.end_at(t);
        }
        do {
            if (size == 0) return;
            --size;
        } while (!(waiting[size].part.enter <= limit));
        index = waiting[size].node;
        part = {waiting[size].part.enter, std::min(waiting[size].part.leave, limit)};
    }
}
// [walk]

/// The accelerator. With the exact test its answers are those of the naive loop, bit for bit.
template <TriangleTest Test = FilteredExact>
class KdTree {
  public:
    using Config = KdTreeConfig;

    template <class Observer = NoObserver>
    static KdTree build(std::span<const Triangle> triangles, const Config& config = {},
                        Observer&& observer = {}) {
        KdTree tree;
        tree.nodes_ = KdBuilder<3>::build(triangles, config, observer);
        tree.placed_ = PlacedTriangles::of(triangles, tree.nodes_.references);
        tree.costs_ = config.costs;
        tree.mailboxes_ = config.mailboxes;
        return tree;
    }
    const KdNodes<3>& nodes() const { return nodes_; }

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
        nodes_.for_each_cell([&](std::uint32_t index, const Aabb& cell, std::size_t) {
            const bool leaf = nodes_.nodes[index].is_leaf();
            leaves += leaf;
            const double tests = costs_.intersection * double(nodes_.own(index).size());
            cost += cell.half_area() * ((leaf ? 0.0 : costs_.traversal) + tests);
        });
        const double whole = nodes_.box.half_area();
        return {.nodes = leaves == 0 ? 0 : 2 * leaves - 1,
                .leaves = leaves,
                .depth = nodes_.depth,
                .references = nodes_.references.size(),
                .bytes = sizeof *this + nodes_.nodes.size() * sizeof(KdNode) +
                         nodes_.references.size() * sizeof(std::uint32_t) +
                         nodes_.kept.size() * sizeof(KdNodes<3>::Range) + placed_.bytes(),
                .sah_cost = whole > 0.0 ? std::optional(cost / whole) : std::nullopt};
    }

  private:
    // [search]
    /// Calls found(hit) for the hits of every triangle that is named where the ray passes; it
    /// returns the t beyond which nothing matters any more.
    template <class Counts, class Found>
    void search(const Ray& ray, Counts& counts, const Found& found) const {
        PlacedTests<Test, Counts, Found> tests{placed_, nodes_.references,  ray, counts,
                                               found,   Mailbox(mailboxes_)};
        walk_cells(nodes_, ray, counts, [&](std::uint32_t node) {
            const auto [first, count] = nodes_.own_range(node);
            return tests.in(first, count);
        });
    }
    // [search]

    KdNodes<3> nodes_;
    PlacedTriangles placed_;
    SahCosts costs_;
    bool mailboxes_ = true;
};

}  // namespace space
