/// @file
/// What a quadtree or octree of points is asked: the k nearest to a point and all within a radius,
/// by chapter 4's NearestSearch and within_radius over OrthtreeSearch, and all in a box. The
/// answers are those of chapter 4's tree, and of a loop over all points in exact numbers.
#pragma once

#include "chapters/ch04_kd_trees/point_search.hpp"
#include "chapters/ch06_quadtrees_and_octrees/linear_orthtree.hpp"
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
#include <limits>
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
    /// Event: the search goes into a cell.
    struct Visited {
        OrthtreeCell<D> cell;
        bool is_leaf;
    };
    /// Event: nothing in the cell can belong to the answer.
    struct Pruned {
        OrthtreeCell<D> cell;
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
        waiting[size++] = {&tree.cells.nodes.front(), 0.0f};
        while (size > 0) {
            const auto [node, distance] = waiting[--size];
            const OrthtreeCell<D> cell = tree.cells.cell(*node);
            if (distance > search.reach) {
                observer.observe(Pruned{cell});
                continue;
            }
            observer.observe(Visited{cell, node->is_leaf()});
            if (node->is_leaf()) look_at(tree, *node, query, search, observer);
            const std::size_t first = size;
            for (const Node& child : tree.cells.children(*node)) {
                const auto box = tree.frame.box(tree.cells.cell(child));
                const Waiting next{&child, distance_to(box, query)};
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
        const Node* node;
        float distance;  ///< squared, from the query to the cell
    };

    // [distance]
    /// From a query to a cell, added up in float just as that of a point is. Rounding never changes
    /// an order, so it is at most that of any point in the cell; corners that are not floats are
    /// rounded first, and then, too, no point of floats is beyond them.
    static float distance_to(const OrthtreeBox<D>& box, const Point<D>& query) {
        constexpr double largest = std::numeric_limits<float>::max();
        const Point<D> low(glm::clamp(box.min, -largest, largest)),
            high(glm::clamp(box.max, -largest, largest));
        return square(glm::max(glm::max(low - query, query - high), Vector<D>{0.0f}));
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
/// The indices of all points in a closed box, ascending. A cell that lies in the box gives its
/// range without a look at its points. `found` keeps its memory from query to query.
template <int D, class Observer = NoObserver>
void points_in_box(const OrthtreePoints<D>& tree, const BasicAabb<D>& box,
                   std::vector<std::uint32_t>& found, Observer&& observer = {}) {
    using Search = OrthtreeSearch<D>;
    found.clear();
    if (tree.size == 0 || box.is_empty()) return;
    const OrthtreeBox<D> asked{Double<D>(box.min), Double<D>(box.max)};
    std::array<const typename Search::Node*, Search::most_waiting> waiting;
    std::size_t size = 0;
    waiting[size++] = &tree.cells.nodes.front();
    while (size > 0) {
        const auto& node = *waiting[--size];
        const OrthtreeCell<D> cell = tree.cells.cell(node);
        const OrthtreeBox<D> its = tree.frame.box(cell);
        if (glm::any(glm::lessThan(its.max, asked.min)) ||
            glm::any(glm::lessThan(asked.max, its.min))) {
            observer.observe(typename Search::Pruned{cell});
            continue;
        }
        observer.observe(typename Search::Visited{cell, node.is_leaf()});
        const bool all = glm::all(glm::lessThanEqual(asked.min, its.min)) &&
                         glm::all(glm::lessThanEqual(its.max, asked.max));
        if (!all && !node.is_leaf()) {
            for (const auto& child : tree.cells.children(node)) waiting[size++] = &child;
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
