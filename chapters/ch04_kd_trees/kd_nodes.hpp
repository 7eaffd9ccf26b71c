/// @file
/// What a k-d tree is: cells cut in two by planes across the axes. kd_builder.hpp makes one.
#pragma once

#include "common/geometry.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// A plane across an axis: one number. What lies in it belongs to one of the halves.
struct KdSplit {
    int axis;
    float position;
    bool coplanar_below = true;  ///< the half that takes what lies in the plane

    bool operator==(const KdSplit&) const = default;
};

// [kd_node]
/// An inner node or a leaf in eight bytes. Two children stand side by side, below first, the pair
/// at an even index: the other child is a flipped bit away.
class KdNode {
  public:
    static KdNode inner(const KdSplit& split, std::uint32_t below, bool keeps = false) {
        return {std::bit_cast<std::uint32_t>(split.position),
                below << 3 | (keeps ? 4u : 0u) | static_cast<std::uint32_t>(split.axis)};
    }
    static KdNode leaf(std::uint32_t first, std::uint32_t count) {
        return {first, count << 3 | 3u};
    }

    bool is_leaf() const { return (low_ & 3u) == 3u; }
    int axis() const { return static_cast<int>(low_ & 3u); }
    float position() const { return std::bit_cast<float>(high_); }
    std::uint32_t below() const { return low_ >> 3; }
    bool keeps() const { return (low_ & 4u) != 0; }  ///< an inner node that has polygons of its own
    std::uint32_t first() const { return high_; }    ///< of a leaf's references
    std::uint32_t count() const { return low_ >> 3; }

    /// All of it as one number, whose lowest bits are those of the axis.
    std::uint64_t bits() const { return std::uint64_t{high_} << 32 | low_; }
    static KdNode of_bits(std::uint64_t bits) {
        return {static_cast<std::uint32_t>(bits >> 32), static_cast<std::uint32_t>(bits)};
    }

    static constexpr std::uint32_t largest = (1u << 29) - 1;  ///< index or count

  private:
    KdNode(std::uint32_t high, std::uint32_t low) : low_(low), high_(high) {}

    std::uint32_t low_, high_;
};
static_assert(sizeof(KdNode) == 8);
// [kd_node]

/// The two closed halves of a cell.
template <int D>
std::pair<BasicAabb<D>, BasicAabb<D>> halves(const BasicAabb<D>& cell, const KdSplit& split) {
    BasicAabb<D> below = cell, above = cell;
    below.max[split.axis] = above.min[split.axis] = split.position;
    return {below, above};
}

/// The tree over polygons that it knows by their indices.
template <int D>
struct KdNodes {
    /// A part of the references.
    struct Range {
        std::uint32_t first = 0, count = 0;
    };

    BasicAabb<D> box;           ///< the root's cell
    std::vector<KdNode> nodes;  ///< the root first, then a gap, then pairs; none for no polygons
    std::vector<std::uint32_t> references;  ///< polygons, by index
    std::vector<Range> kept;  ///< by node: what inner nodes keep; empty where none keeps any
    std::size_t depth = 0;    ///< edges from the root to the deepest leaf

    bool empty() const { return nodes.empty(); }
    KdNode node(std::uint32_t index) const { return nodes[index]; }

    /// What a leaf names, or an inner node keeps.
    Range own_range(std::uint32_t index) const {
        const KdNode node = nodes[index];
        if (node.is_leaf()) return {node.first(), node.count()};
        return node.keeps() ? kept[index] : Range{};
    }
    std::span<const std::uint32_t> own(std::uint32_t index) const {
        const Range range = own_range(index);
        return std::span(references).subspan(range.first, range.count);
    }

    /// Calls visit(index, cell, depth) for each node, below before above.
    template <class Visit>
    void for_each_cell(const Visit& visit) const {
        if (!nodes.empty()) for_each_cell(0, box, 0, visit);
    }

  private:
    template <class Visit>
    void for_each_cell(std::uint32_t index, const BasicAabb<D>& cell, std::size_t level,
                       const Visit& visit) const {
        visit(index, cell, level);
        const KdNode node = nodes[index];
        if (node.is_leaf()) return;
        const auto [below, above] = halves(cell, {node.axis(), node.position()});
        for_each_cell(node.below(), below, level + 1, visit);
        for_each_cell(node.below() + 1, above, level + 1, visit);
    }
};

}  // namespace space
