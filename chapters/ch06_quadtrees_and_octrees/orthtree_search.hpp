/// @file
/// What a quadtree or octree of points is asked: the k nearest to a point and all within a radius,
/// by chapter 4's NearestSearch and within_radius over OrthtreeSearch, and all in a box. The
/// answers are those of chapter 4's tree, and of a loop over all points in exact numbers.
#pragma once

#include "chapters/ch04_kd_trees/point_search.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_points.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace space {

/// A query on its way through the cells of a tree:
///
///     NearestSearch<3, OrthtreeSearch<3>> search(tree, k);
///     within_radius<3, OrthtreeSearch<3>>(tree, query, radius, found);
template <int D>
class OrthtreeSearch {
  public:
    using Tree = OrthtreePoints<D>;
    using Node = typename Tree::Node;
    /// At each depth the children of one cell, of which one is gone on to.
    static constexpr std::size_t most_waiting = 1 + max_orthtree_depth<D> * (orthants<D> - 1);
    /// Event: the search goes into a node.
    struct Visited {
        std::uint32_t node;
        bool is_leaf;
    };
    /// Event: nothing in the node can belong to the answer.
    struct Pruned {
        std::uint32_t node;
    };
    /// Event: floats can't leave this point out.
    struct Compared {
        std::uint32_t index;
    };

    // [run]
    /// Offers `search.consider(distance, place)` every point whose squared distance in float is at
    /// most `search.reach`, which may shrink on the way. Of a cell's children the nearest comes
    /// first. The tree is not empty, and the query is finite.
    template <class Search, class Observer>
    static void run(const Tree& tree, const Point<D>& query, Search& search, Observer& observer) {
        std::array<Waiting, most_waiting> waiting;  // the last is the next
        std::size_t size = 0;
        waiting[size++] = {0, distance_to(tree.boxes[0], query)};
        while (size > 0) {
            const auto [index, distance] = waiting[--size];
            const Node& node = tree.cells.nodes[index];
            if (distance > search.reach) {
                observer.observe(Pruned{index});
                continue;
            }
            observer.observe(Visited{index, node.is_leaf()});
            if (node.is_leaf()) look_at(tree, node, query, search, observer);
            const std::size_t first = size, children = tree.cells.children(node).size();
            for (std::uint32_t child = node.children; child < node.children + children; ++child) {
                const Waiting next{child, distance_to(tree.boxes[child], query)};
                std::size_t at = size++;
                for (; at > first && waiting[at - 1].distance <= next.distance; --at)
                    waiting[at] = waiting[at - 1];
                waiting[at] = next;
            }
        }
    }
    // [run]

  private:
    struct Waiting {
        std::uint32_t node;
        float distance;  ///< squared, from the query to the node's box
    };

    // [distance]
    /// From a query to a box, added up in float just as that of a point is. Rounding never changes
    /// an order, so it is at most that of any point in the box. The box is what a cell's points
    /// fill: often smaller than the cell, and made of floats.
    static float distance_to(const BasicAabb<D>& box, const Point<D>& query) {
        return square(glm::max(glm::max(box.min - query, query - box.max), Vector<D>{0.0f}));
    }
    // [distance]
    static float square(const Vector2& v) { return v.x * v.x + v.y * v.y; }
    static float square(const Vector3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

    template <class Search, class Observer>
    static void look_at(const Tree& tree, const Node& leaf, const Point<D>& query, Search& search,
                        Observer& observer) {
        for (std::uint32_t place = leaf.first; place < leaf.last; ++place) {
            const float distance = square(query - tree.point(place));
            if (distance > search.reach) continue;
            observer.observe(Compared{tree.index(place)});
            search.consider(distance, place);
        }
    }
};

// [points_in_box]
/// The indices of all points in a closed box, ascending. Of a cell whose points all lie in it
/// none is looked at. `found` keeps its memory from query to query.
template <int D, class Observer = NoObserver>
void points_in_box(const OrthtreePoints<D>& tree, const BasicAabb<D>& box,
                   std::vector<std::uint32_t>& found, Observer&& observer = {}) {
    using Search = OrthtreeSearch<D>;
    found.clear();
    if (tree.size == 0 || box.is_empty()) return;
    std::array<std::uint32_t, Search::most_waiting> waiting;
    std::size_t size = 0;
    waiting[size++] = 0;
    while (size > 0) {
        const std::uint32_t index = waiting[--size];
        const auto& node = tree.cells.nodes[index];
        const BasicAabb<D>& its = tree.boxes[index];
        if (glm::any(glm::lessThan(its.max, box.min)) ||
            glm::any(glm::lessThan(box.max, its.min))) {
            observer.observe(typename Search::Pruned{index});
            continue;
        }
        observer.observe(typename Search::Visited{index, node.is_leaf()});
        const bool all = box.contains(its);
        if (!all && !node.is_leaf()) {
            const std::size_t children = tree.cells.children(node).size();
            for (std::uint32_t k = 0; k < children; ++k) waiting[size++] = node.children + k;
            continue;
        }
        for (std::uint32_t place = node.first; place < node.last; ++place) {
            if (!all) observer.observe(typename Search::Compared{tree.index(place)});
            if (all || box.contains(tree.point(place))) found.push_back(tree.index(place));
        }
    }
    std::ranges::sort(found);
}
// [points_in_box]

}  // namespace space
