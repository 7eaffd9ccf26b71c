/// @file
/// A quadtree or octree of points: each in the half-open cell that it lies in, sorted by Morton
/// code. orthtree_search.hpp asks it.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/linear_orthtree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/morton_order.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// Points in the leaves of a tree, each in one.
template <int D>
struct OrthtreePoints {
    using Config = LinearOrthtreeConfig;
    using Node = typename LinearOrthtree<D>::Node;

    std::size_t size = 0;  ///< points
    OrthtreeFrame<D> frame = {};
    LinearOrthtree<D> cells = {};
    std::vector<BasicAabb<D>> boxes = {};     ///< of the nodes, around their points
    std::vector<Point<D>> points = {};        ///< copies, in the order of the cells' items
    std::vector<std::uint32_t> indices = {};  ///< of these, among the points given

    /// Of any number of points, equal ones too, in the smallest frame that holds them.
    /// @throws std::invalid_argument for a point that is not finite
    /// @throws LimitError for more than 2^32 - 1 points
    template <class Observer = NoObserver>
    static OrthtreePoints build(std::span<const Point<D>> points, const Config& config = {},
                                Observer&& observer = {}) {
        BasicAabb<D> box;
        for (const Point<D>& point : points)
            if (is_finite<D>(point)) box.extend(point);
        return build(points, OrthtreeFrame<D>::around(box), config, observer);
    }

    // [build]
    /// The same in a given frame.
    /// @throws std::invalid_argument for a point that is not in it, too
    template <class Observer = NoObserver>
    static OrthtreePoints build(std::span<const Point<D>> points, const OrthtreeFrame<D>& frame,
                                const Config& config = {}, Observer&& observer = {}) {
        check(points, frame);
        auto [codes, indices] = morton_order(frame, points);
        OrthtreePoints tree{.size = points.size(), .frame = frame};
        tree.points.reserve(points.size());
        for (const std::uint32_t index : indices) tree.points.push_back(points[index]);
        tree.indices = std::move(indices);
        tree.cells = LinearOrthtree<D>::build(std::move(codes), config, observer);
        tree.boxes = boxes_around(tree.cells, [&](BasicAabb<D>& box, std::uint32_t item) {
            box.extend(tree.points[item]);
        });
        return tree;
    }
    // [build]

    /// Of the point that stands in this place of the order of cells.
    const Point<D>& point(std::uint32_t place) const { return points[place]; }
    std::uint32_t index(std::uint32_t place) const { return indices[place]; }

  private:
    static void check(std::span<const Point<D>> points, const OrthtreeFrame<D>& frame) {
        if (points.size() > std::numeric_limits<std::uint32_t>::max())
            throw LimitError("orthtree: more than 4294967295 points");
        for (std::size_t i = 0; i < points.size(); ++i)
            if (const char* fault = fault_of(points[i], frame.box()))
                throw std::invalid_argument("orthtree: point " + std::to_string(i) + fault);
    }
    static const char* fault_of(const Point<D>& point, const OrthtreeBox<D>& root) {
        if (!is_finite<D>(point)) return " is not finite";
        for (int axis = 0; axis < D; ++axis)
            if (double{point[axis]} < root.min[axis] || double{point[axis]} > root.max[axis])
                return " lies outside of the root";
        return nullptr;
    }
};

}  // namespace space
