/// @file
/// Rays in a quadtree or octree: front to back through the cells that the ray meets, by a slab test
/// of each child, or by the parameters of the planes that children share.
#pragma once

#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_config.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_nodes.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace space {

// [span]
/// Where a ray's line lies between two planes across an axis, or beyond one: not less than in exact
/// arithmetic.
///
/// Planes are doubles, exactly where the tree has them, so that chapter 4's count holds: three
/// roundings make a plane's t, which is off by at most gamma(3) |T| from the exact T, and of the
/// right sign. With u53 = 2^-53, t (1 +- 8 u53) lies beyond T after its own rounding. So let a
/// point of the ray lie in a child's closed cell, at T. Each plane that the ray must have passed to
/// be there has been passed at T or before, in exact arithmetic, and `begin` is not larger; each
/// plane that it has not passed lies at T or beyond, and `end` is not smaller. Both hold for the
/// part that the node was given, by induction, and so for what the child is given: it holds T, the
/// child is visited. No two planes are compared with each other: which of them comes first decides
/// nothing.
struct PlaneSpan {
    double begin = -infinity, end = infinity;

    void begin_at(double t) { begin = std::min(t * (1.0 - margin), t * (1.0 + margin)); }
    void end_at(double t) { end = std::max(t * (1.0 - margin), t * (1.0 + margin)); }

    static constexpr double margin = RayPart::margin;
};

/// The part of the ray that lies in the span, too. A plane's t along a plane is +-infinity and
/// excludes all of one side; within it, it is not a number, and excludes nothing.
inline RayPart within(RayPart part, const PlaneSpan& span) {
    if (span.begin > part.enter) part.enter = span.begin;
    if (span.end < part.leave) part.leave = span.end;
    return part;
}
// [span]

/// Event: the walk has come to a node, with this part of the ray in its cell.
template <int D, class Handle = std::uint32_t>
struct OrthtreeVisit {
    Handle node;
    OrthtreeCube<D> cube;
    RayPart part;
};

/// What both walks need of a ray.
template <int D>
struct OrthtreeRay : KdRay<D> {
    std::uint32_t flip = 0;  ///< child k ^ flip is the k-th in the order of the ray

    explicit OrthtreeRay(const BasicRay<D>& ray) : KdRay<D>(ray) {
        for (std::size_t axis = 0; axis < D; ++axis) flip |= (1u - this->far[axis]) << axis;
    }
    /// A mask of children with its bits in the order of the ray.
    std::uint32_t seen(std::uint32_t mask) const {
        for (std::uint32_t axis = 0; axis < D; ++axis)
            if ((flip >> axis & 1u) != 0) {  // the same for all nodes of the ray
                const std::uint32_t half = 1u << axis, lower = lower_children<D>(axis);
                mask = (mask & lower) << half | (mask >> half & lower);
            }
        return mask;
    }
};

// [plain]
/// The plain way: recursive, with a slab test of each child. In the order of the ray a child comes
/// after all from which the ray can come to it: counting does that, since the number of such a
/// child has a part of its bits.
template <class Nodes, int D, class Counts, class Own, class Observer>
class PlainWalk {
  public:
    void visit(const OrthtreeVisit<D, typename Nodes::Handle>& at) {
        counts.visit_node();
        observer.observe(at);
        const auto& node = tree.node(at.node);
        if (node.count > 0) limit = own(at.node);
        for (std::uint32_t k = 0; k < orthants<D>; ++k) {
            const std::uint32_t child = k ^ ray.flip;
            if (!node.has(child)) continue;
            const OrthtreeCube<D> cube = at.cube.child(child);
            const RayPart part = part_in_box(cube.box(tree.looseness), at.part);
            if (part.enter <= part.leave && part.enter <= limit)
                visit({node.child(child), cube, part});
        }
    }

    const Nodes& tree;
    const OrthtreeRay<D> ray;
    Counts& counts;
    const Own& own;
    Observer& observer;
    double limit = infinity;

  private:
    RayPart part_in_box(const OrthtreeBox<D>& box, RayPart part) const {
        for (int axis = 0; axis < D; ++axis) {
            const bool upwards = ray.far[std::size_t(axis)] == 1;
            PlaneSpan span;
            span.begin_at(ray.distance(axis, (upwards ? box.min : box.max)[axis]));
            span.end_at(ray.distance(axis, (upwards ? box.max : box.min)[axis]));
            part = within(part, span);
        }
        return part;
    }
};
// [plain]

// [parametric]
/// The parametric way (Revelles, Urena & Lastra 2000): seen from the ray, each axis has a near half
/// and a far one, and the plane between them has one parameter for all children. So D parameters
/// take the place of the 2 D 2^D in the slab tests. A child is met where the ray has come to all of
/// its far halves, and not yet left its near ones. (The paper halves parameters on the way down;
/// here they are computed from planes, whose coordinates are exact, so that errors don't add up.)
///
/// Here are the parts of all children, by their numbers in the order of the ray: bit `axis` is set
/// for the far half. (Loops this short stay loops at -O2 unless they are told not to, and cost more
/// than what is in them.)
template <int D>
struct ChildParts {
    std::array<double, orthants<D>> enter, leave;

    explicit ChildParts(const RayPart& part) : enter{part.enter}, leave{part.leave} {}

    /// Doubles what the axes before this one have made: a near half and a far one.
    void cut(int axis, const PlaneSpan& near, const PlaneSpan& far) {
        const std::uint32_t half = 1u << axis;
#pragma GCC unroll 8
        for (std::uint32_t k = 0; k < half; ++k) {
            enter[k | half] = std::max(enter[k], far.begin);
            leave[k | half] = std::min(leave[k], far.end);
            enter[k] = std::max(enter[k], near.begin);
            leave[k] = std::min(leave[k], near.end);
        }
    }
    /// The same with one plane between the halves: the part does not reach beyond their outer ones.
    void cut(int axis, const PlaneSpan& middle) {
        const std::uint32_t half = 1u << axis;
#pragma GCC unroll 8
        for (std::uint32_t k = 0; k < half; ++k) {
            enter[k | half] = std::max(enter[k], middle.begin);
            leave[k | half] = leave[k];
            leave[k] = std::min(leave[k], middle.end);
        }
    }
    /// The children that the ray meets: bit k for the k-th.
    std::uint32_t met() const {
        std::uint32_t mask = 0;
#pragma GCC unroll 8
        for (std::uint32_t k = 0; k < orthants<D>; ++k)
            mask |= static_cast<std::uint32_t>(enter[k] <= leave[k]) << k;
        return mask;
    }
};

template <int D>
ChildParts<D> tight_parts(const OrthtreeRay<D>& ray, const OrthtreeCube<D>& cube,
                          const RayPart& part) {
    ChildParts<D> parts(part);
#pragma GCC unroll 8
    for (int axis = 0; axis < D; ++axis) {
        const double t = ray.distance(axis, cube.centre[axis]);
        PlaneSpan middle;
        middle.begin_at(t);
        middle.end_at(t);
        parts.cut(axis, middle);
    }
    return parts;
}
/// Halves of a loose cell overlap, and are narrower than the part on their outer sides, too.
template <int D>
ChildParts<D> loose_parts(const OrthtreeRay<D>& ray, const OrthtreeCube<D>& cube,
                          const RayPart& part, double looseness) {
    const OrthtreeBox<D> below = cube.child(0).box(looseness),
                         above = cube.child(orthants<D> - 1).box(looseness);
    ChildParts<D> parts(part);
#pragma GCC unroll 8
    for (int axis = 0; axis < D; ++axis) {
        const bool upwards = ray.far[std::size_t(axis)] == 1;
        const auto span_of = [&](const OrthtreeBox<D>& half) {
            PlaneSpan span;
            span.begin_at(ray.distance(axis, (upwards ? half.min : half.max)[axis]));
            span.end_at(ray.distance(axis, (upwards ? half.max : half.min)[axis]));
            return span;
        };
        parts.cut(axis, span_of(upwards ? below : above), span_of(upwards ? above : below));
    }
    return parts;
}

template <class Nodes, int D, class Counts, class Own, class Observer, class Parts>
void walk_by_parameters(const Nodes& tree, const OrthtreeRay<D>& ray,
                        const OrthtreeVisit<D, typename Nodes::Handle>& root, Counts& counts,
                        const Own& own, Observer& observer, const Parts& parts_of) {
    using Visit = OrthtreeVisit<D, typename Nodes::Handle>;
    // A node waits beside at most 2^D - 1 others on each level.
    std::array<Visit, (orthants<D> - 1) * max_orthtree_depth<D> + 1> waiting;
    std::size_t size = 0;
    waiting[size++] = root;
    double limit = infinity;
    while (size > 0) {
        const Visit at = waiting[--size];
        if (!(at.part.enter <= limit)) continue;
        counts.visit_node();
        observer.observe(at);
        const auto& node = tree.node(at.node);
        if (node.count > 0) limit = own(at.node);
        if (node.is_leaf()) continue;
        const ChildParts<D> parts = parts_of(at);
        // The nearest is to be the next in hand.
        for (std::uint32_t met = parts.met() & ray.seen(node.mask); met != 0;) {
            const auto k = static_cast<std::uint32_t>(std::bit_width(met)) - 1;
            met ^= 1u << k;
            const std::uint32_t child = k ^ ray.flip;
            waiting[size++] = {
                node.child(child), at.cube.child(child), {parts.enter[k], parts.leave[k]}};
        }
    }
}
// [parametric]

/// Walks the cells along the ray. Calls own(node) for every node that names polygons; it returns
/// the t beyond which nothing matters any more (NaN: nothing at all). The observer is told every
/// node (OrthtreeVisit). Both ways visit the same nodes in the same order, and know the same parts.
/// Nodes is OrthtreeNodes, or what has its `frame`, `bounds`, `looseness`, `empty()`, `root()` and
/// `node(handle)`.
template <class Nodes, int D, class Counts, class Own, class Observer = NoObserver>
void walk_orthtree(const Nodes& tree, OctreeConfig::Walk way, const BasicRay<D>& ray,
                   Counts& counts, const Own& own, Observer&& observer = {}) {
    if (!is_valid(ray) || tree.empty()) return;
    const OrthtreeRay<D> prepared(ray);
    const std::optional<RayPart> part = part_in(tree.bounds, prepared, RayPart::all_of(ray));
    if (!part) return;
    const OrthtreeVisit<D, typename Nodes::Handle> root{tree.root(),
                                                        OrthtreeCube<D>::of(tree.frame), *part};
    if (way == OctreeConfig::Walk::plain) {
        PlainWalk<Nodes, D, Counts, Own, std::remove_reference_t<Observer>>{tree, prepared, counts,
                                                                            own, observer}
            .visit(root);
    } else if (tree.looseness == 1.0) {
        walk_by_parameters(tree, prepared, root, counts, own, observer,
                           [&](const auto& at) { return tight_parts(prepared, at.cube, at.part); });
    } else {
        walk_by_parameters(tree, prepared, root, counts, own, observer, [&](const auto& at) {
            return loose_parts(prepared, at.cube, at.part, tree.looseness);
        });
    }
}

}  // namespace space
