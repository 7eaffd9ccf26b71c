/// @file
/// What a bounding volume hierarchy is: boxes that hold boxes that hold polygons. All builders of
/// the chapter make this one.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "common/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

// [bvh_node]
/// An inner node, whose two children stand side by side, or a leaf, which names at least one
/// polygon.
template <int D>
struct BvhNode {
    BasicAabb<D> box;         ///< around all that is below
    std::uint32_t first = 0;  ///< of two children, or of a leaf's references
    std::uint32_t count = 0;  ///< of a leaf's references; none of an inner node

    bool is_leaf() const { return count > 0; }
    bool operator==(const BvhNode&) const = default;
};
static_assert(sizeof(BvhNode<3>) == 32);
// [bvh_node]

/// What rays cost, in any unit. By the clock a step to two children costs about as much as a test;
/// it counts for more, since a smaller tree spares memory and the time to fetch it.
struct BvhCosts {
    double traversal = 2.25;    ///< C_V, of an inner node: both children's boxes
    double intersection = 1.0;  ///< C_NS, of a triangle

    /// Whether a node of two leaves is cheaper than one leaf of all `size` triangles: `tests` are
    /// those that a ray is expected to make in the two, P(first) count + P(second) count; infinite
    /// where there is no cut, which then pays at no costs.
    bool cut_pays(double tests, std::size_t size) const {
        return tests < infinity && traversal + intersection * tests < intersection * double(size);
    }
};

/// The chance that a ray through a box meets a box inside of it: the ratio of their surfaces. Where
/// the outer one is a line, that of their lengths; where it is a point, 1.
template <int D>
class HitChance {
  public:
    explicit HitChance(const BasicAabb<D>& outer)
        : by_area_(half_area(outer) > 0.0), whole_(by_area_ ? half_area(outer) : length(outer)) {}

    double operator()(const BasicAabb<D>& inner) const { return weight(inner) / whole(); }
    /// What the chance is in proportion to: the same without a division.
    double weight(const BasicAabb<D>& inner) const {
        return by_area_ ? half_area(inner) : whole_ > 0.0 ? length(inner) : 1.0;
    }
    double whole() const { return whole_ > 0.0 ? whole_ : 1.0; }  ///< the outer one's weight

  private:
    /// In double from the start: where coordinates are near the largest float, an extent in float
    /// is infinite, and costs would not be numbers.
    static double half_area(const BasicAabb<D>& box) {
        const Double<D> e = Double<D>(box.max) - Double<D>(box.min);
        if constexpr (D == 2)
            return e.x + e.y;
        else
            return e.x * e.y + (e.x + e.y) * e.z;
    }
    static double length(const BasicAabb<D>& box) {
        double sum = 0.0;
        for (int axis = 0; axis < D; ++axis) sum += double{box.max[axis]} - double{box.min[axis]};
        return sum;
    }

    bool by_area_;
    double whole_;
};

/// The deepest tree that rays can walk: their stack has a place for each edge from the root down.
/// (Four kilobytes and more, of which a ray touches what it needs.) Builders stay below it.
inline constexpr unsigned max_bvh_depth = 1024;

/// The tree over polygons that it knows by their indices.
template <int D>
struct BvhNodes {
    /// The root, a gap that makes later pairs even, then pairs of siblings: a node's pair, all that
    /// is below the first, all that is below the second. None at all for no polygons.
    std::vector<BvhNode<D>, CacheLineAllocator<BvhNode<D>>> nodes;
    std::vector<std::uint32_t> references;  ///< polygons, by index
    unsigned depth = 0;                     ///< edges from the root to the deepest leaf

    bool empty() const { return nodes.empty(); }
    /// Inner nodes and leaves, without the gap.
    std::size_t size() const { return empty() ? 0 : nodes.size() - 1; }

    /// What a leaf names; nothing for an inner node.
    std::span<const std::uint32_t> own(std::uint32_t index) const {
        const BvhNode<D>& node = nodes[index];
        return node.is_leaf() ? std::span(references).subspan(node.first, node.count)
                              : std::span<const std::uint32_t>{};
    }

    // [for_each_node]
    /// Calls visit(index, depth) for each node, the parent before its children, the first child and
    /// what is below it before the second.
    template <class Visit>
    void for_each_node(const Visit& visit) const {
        struct Waiting {
            std::uint32_t node;
            unsigned depth;
        };
        std::vector<Waiting> waiting;
        if (!empty()) waiting.push_back({0, 0});
        while (!waiting.empty()) {
            const auto [index, level] = waiting.back();
            waiting.pop_back();
            visit(index, level);
            if (nodes[index].is_leaf()) continue;
            waiting.push_back({nodes[index].first + 1, level + 1});
            waiting.push_back({nodes[index].first, level + 1});
        }
    }
    // [for_each_node]

    // [sah_cost]
    /// The expected cost of a ray that meets the root's box (MacDonald & Booth 1990, as it is for
    /// boxes in Goldsmith & Salmon 1987).
    double sah_cost(const BvhCosts& costs) const {
        if (empty()) return 0.0;
        const HitChance<D> chance(nodes[0].box);
        double cost = 0.0;
        for_each_node([&](std::uint32_t index, unsigned) {
            const BvhNode<D>& node = nodes[index];
            if (node.box.is_empty()) return;  // after a refit, where nothing is finite any more
            cost += chance(node.box) *
                    (node.is_leaf() ? costs.intersection * node.count : costs.traversal);
        });
        return cost;
    }
    // [sah_cost]
};

}  // namespace space
