/// @file
/// A k-d tree of points in D = 2 or 3 dimensions (Bentley 1975, "Multidimensional Binary Search
/// Trees Used for Associative Searching"; Friedman, Bentley & Finkel 1977, "An Algorithm for
/// Finding Best Matches in Logarithmic Expected Time"). point_search.hpp asks it.
#pragma once

#include "common/geometry.hpp"
#include "common/limit_error.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace space {

/// Points in buckets of eight, as the tree's leaves from left to right; only the last may hold
/// fewer. A subtree is a range of buckets. Its node, which parts it in the middle, stands at the
/// middle's number: no pointers are needed, and nodes near in the tree are near in memory.
template <int D>
struct KdPoints {
    static constexpr std::size_t bucket_size = 8;
    /// Axis by axis, so that one instruction takes several points. A place without a point holds
    /// NaN, which no comparison lets through.
    struct alignas(32) Bucket {
        std::array<std::array<float, bucket_size>, D> coordinate;
        std::array<std::uint32_t, bucket_size> index;
    };
    /// Nothing lies between the children: `left` is the largest coordinate on the axis in the left
    /// one, `right` the smallest in the right one.
    struct Node {
        float left, right;
        std::uint32_t axis;
    };
    /// Buckets first .. last - 1.
    struct Subtree {
        std::uint32_t first, last;

        bool is_bucket() const { return last - first == 1; }
        std::uint32_t middle() const { return first + (last - first) / 2; }
        Subtree left() const { return {first, middle()}; }
        Subtree right() const { return {middle(), last}; }
        bool operator==(const Subtree&) const = default;
    };

    std::size_t size = 0;      ///< points
    BasicAabb<D> bounds = {};  ///< of all of them
    std::vector<Bucket> buckets = {};
    std::vector<Node> nodes = {};  ///< as many as buckets; the first is unused

    /// Of any number of points, equal ones too.
    /// @throws std::invalid_argument for a point that is not finite
    /// @throws LimitError for more than 2^32 - 1 points
    static KdPoints build(std::span<const Point<D>> points);

    Subtree root() const { return {0, static_cast<std::uint32_t>(buckets.size())}; }
    /// Of a subtree that is more than a bucket.
    const Node& node(const Subtree& subtree) const { return nodes[subtree.middle()]; }
    /// The point in place slot % 8 of bucket slot / 8.
    Point<D> point(std::uint32_t slot) const {
        const auto& along = buckets[slot / bucket_size].coordinate;
        const std::size_t place = slot % bucket_size;
        if constexpr (D == 2)
            return {along[0][place], along[1][place]};
        else
            return {along[0][place], along[1][place], along[2][place]};
    }
    std::uint32_t index(std::uint32_t slot) const {
        return buckets[slot / bucket_size].index[slot % bucket_size];
    }
};

/// Sorts points into buckets.
template <int D>
class KdPointsBuilder {
  public:
    static KdPoints<D> build(std::span<const Point<D>> points) {
        if (points.size() > std::numeric_limits<std::uint32_t>::max())
            throw LimitError("k-d tree: more than 4294967295 points");
        KdPointsBuilder builder;
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            if (!is_finite<D>(points[i]))
                throw std::invalid_argument("k-d tree: point " + std::to_string(i) +
                                            " is not finite");
            builder.items_.push_back({points[i], i});
        }
        return builder.run();
    }

  private:
    using Subtree = typename KdPoints<D>::Subtree;
    using Bucket = typename KdPoints<D>::Bucket;
    static constexpr std::size_t bucket_size = KdPoints<D>::bucket_size;
    struct Item {
        Point<D> point;
        std::uint32_t index;
    };
    using Place = typename std::vector<Item>::iterator;

    KdPoints<D> run() {
        KdPoints<D> tree;
        tree.size = items_.size();
        tree.buckets.resize((items_.size() + bucket_size - 1) / bucket_size);
        tree.nodes.resize(tree.buckets.size());
        if (!items_.empty()) tree.bounds = split(tree, tree.root());
        return tree;
    }

    // [split]
    /// Halves a subtree's points across the axis along which they reach farthest, so that cells
    /// don't become long and thin: a ball meets fewer cells that are nearly cubes. The median keeps
    /// the depth at log2 n, whatever the points. Equal coordinates are told apart by their index:
    /// the halves are the same on every machine.
    BasicAabb<D> split(KdPoints<D>& tree, const Subtree& subtree) {
        const Place begin = first_of(subtree.first), end = first_of(subtree.last);
        BasicAabb<D> box;
        for (Place item = begin; item != end; ++item) box.extend(item->point);
        if (subtree.is_bucket()) {
            fill(tree.buckets[subtree.first], {begin, end});
            return box;
        }
        const int axis = box.longest_axis();
        std::nth_element(begin, first_of(subtree.middle()), end,
                         [axis](const Item& a, const Item& b) {
                             if (a.point[axis] != b.point[axis])
                                 return a.point[axis] < b.point[axis];
                             return a.index < b.index;
                         });
        const float left = split(tree, subtree.left()).max[axis];
        const float right = split(tree, subtree.right()).min[axis];
        tree.nodes[subtree.middle()] = {left, right, static_cast<std::uint32_t>(axis)};
        return box;
    }
    // [split]

    Place first_of(std::uint32_t bucket) {
        const std::size_t first = std::min(bucket_size * bucket, items_.size());
        return items_.begin() + static_cast<std::ptrdiff_t>(first);
    }

    static void fill(Bucket& bucket, std::span<Item> items) {
        std::ranges::sort(items, {}, &Item::index);
        for (auto& along : bucket.coordinate) along.fill(std::numeric_limits<float>::quiet_NaN());
        bucket.index.fill(std::numeric_limits<std::uint32_t>::max());
        for (std::size_t i = 0; i < items.size(); ++i) {
            for (int axis = 0; axis < D; ++axis) bucket.coordinate[axis][i] = items[i].point[axis];
            bucket.index[i] = items[i].index;
        }
    }

    std::vector<Item> items_;
};

template <int D>
KdPoints<D> KdPoints<D>::build(std::span<const Point<D>> points) {
    return KdPointsBuilder<D>::build(points);
}

}  // namespace space
