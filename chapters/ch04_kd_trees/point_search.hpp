/// @file
/// What a k-d tree of points is asked: the k nearest to a point, all within a radius, all in a box.
/// Answers are those of a loop over all points in exact numbers. A query that is not finite finds
/// nothing. The first two serve any tree: what they need of it is a type like PointSearch, with its
/// `Tree` and `run`, and of the tree `size`, `point(slot)` and `index(slot)`.
#pragma once

#include "chapters/ch04_kd_trees/kd_points.hpp"
#include "chapters/ch04_kd_trees/squared_distance.hpp"
#include "common/observer.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// A query on its way through the cells of a tree: where it goes, and what it leaves out.
template <int D>
class PointSearch {
  public:
    using Tree = KdPoints<D>;
    using Subtree = typename Tree::Subtree;
    /// Event: the search goes into a subtree.
    struct Visited {
        Subtree subtree;
    };
    /// Event: nothing in the subtree can belong to the answer.
    struct Pruned {
        Subtree subtree;
    };
    /// Event: floats can't leave this point out.
    struct Compared {
        std::uint32_t index;
    };

    // [run]
    /// Offers `search.consider(distance, slot)` every point whose squared distance in float is at
    /// most `search.reach`, which may shrink on the way. Of two cells the nearer comes first. The
    /// tree is not empty, and the query is finite.
    template <class Search, class Observer>
    static void run(const Tree& tree, const Point<D>& query, Search& search, Observer& observer) {
        std::array<Cell, 32> waiting;  // one a level at most
        std::size_t size = 0;
        waiting[size++] = root_cell(tree, query);
        while (size > 0) {
            if (waiting[--size].distance > search.reach) {
                observer.observe(Pruned{waiting[size].subtree});
                continue;
            }
            Cell cell = waiting[size];
            while (!cell.subtree.is_bucket()) {
                observer.observe(Visited{cell.subtree});
                go_near(tree, query, cell, waiting[size++]);
            }
            observer.observe(Visited{cell.subtree});
            look_at(tree, cell.subtree.first, query, search, observer);
        }
    }
    // [run]

  private:
    // [cell]
    /// A subtree, and how far the query is from it on each axis, squared: 0 where it lies between
    /// the cell's sides. The distance is added up in float just as that of a point is. Rounding
    /// never changes an order (x <= y gives fl(x) <= fl(y)), so it is at most that of any point in
    /// the cell: what is left out with a cell would have been left out by itself.
    struct Cell {
        Subtree subtree;
        Vector<D> offset;
        float distance;

        void set(int axis, float away) {
            offset[axis] = away * away;
            distance = sum(offset);
        }
    };
    // [cell]
    static float sum(const Vector2& v) { return v.x + v.y; }
    static float sum(const Vector3& v) { return v.x + v.y + v.z; }

    static Cell root_cell(const Tree& tree, const Point<D>& query) {
        const Vector<D> below = tree.bounds.min - query, above = query - tree.bounds.max;
        const Vector<D> away = glm::max(glm::max(below, above), Vector<D>{0.0f});
        return {tree.root(), away * away, sum(away * away)};
    }

    // [go_near]
    /// Goes to the child whose side is nearer to the query; the other one is `far`.
    static void go_near(const Tree& tree, const Point<D>& query, Cell& cell, Cell& far) {
        const auto& node = tree.node(cell.subtree);
        const auto axis = static_cast<int>(node.axis);
        const float from_left = query[axis] - node.left, to_right = node.right - query[axis];
        const bool near_left = from_left < to_right;
        const Subtree left = cell.subtree.left(), right = cell.subtree.right();
        far.subtree = near_left ? right : left;
        cell.subtree = near_left ? left : right;
        far.offset = cell.offset;
        far.set(axis, near_left ? to_right : from_left);
    }
    // [go_near]

    template <class Search, class Observer>
    static void look_at(const Tree& tree, std::uint32_t bucket, const Point<D>& query,
                        Search& search, Observer& observer) {
        const auto& points = tree.buckets[bucket];
        const auto distance = distances(points, query);
        if (!any_within(distance, search.reach)) return;
        for (std::uint32_t i = 0; i < Tree::bucket_size; ++i)
            if (distance[i] <= search.reach) {
                observer.observe(Compared{points.index[i]});
                search.consider(distance[i], std::uint32_t{Tree::bucket_size} * bucket + i);
            }
    }

    using Distances = std::array<float, Tree::bucket_size>;
    static Distances distances(const typename Tree::Bucket& bucket, const Point<D>& query) {
        Distances distance{};
        for (int axis = 0; axis < D; ++axis) {
            const float at = query[axis];
            const auto& along = bucket.coordinate[axis];
            for (std::size_t i = 0; i < Tree::bucket_size; ++i) {
                const float away = at - along[i];
                distance[i] += away * away;
            }
        }
        return distance;
    }
    static bool any_within(const Distances& distance, float reach) {
        std::uint32_t any = 0;
        for (std::size_t i = 0; i < Tree::bucket_size; ++i) any |= distance[i] <= reach;
        return any != 0;
    }
};

/// Which of two points, named by their slots in `index`, comes first: the nearer one, exactly; of
/// equally near ones that with the lower index.
template <int D, class Tree = KdPoints<D>>
struct TrueOrder {
    const Tree& tree;
    Point<D> query;

    Neighbour neighbour(std::uint32_t slot) const {
        return {slot, squared_distance<D>(query, tree.point(slot))};
    }
    bool operator()(const Neighbour& a, const Neighbour& b) const {
        if (certainly_less<D>(a.squared_distance, b.squared_distance)) return true;
        if (certainly_less<D>(b.squared_distance, a.squared_distance)) return false;
        const int order = exact_order(a, b);
        return order != 0 ? order < 0 : tree.index(a.index) < tree.index(b.index);
    }
    /// From slots to the points' own indices.
    void name(std::span<Neighbour> neighbours) const {
        for (Neighbour& neighbour : neighbours) neighbour.index = tree.index(neighbour.index);
    }

  private:
    /// Of two squared distances that are equal, or nearly so: -1, 0 or 1.
    int exact_order(const Neighbour& a, const Neighbour& b) const {
        const Point<D> p = tree.point(a.index), q = tree.point(b.index);
        if (is_squared_distance_exact<D>(query, p) && is_squared_distance_exact<D>(query, q))
            return (a.squared_distance > b.squared_distance) -
                   (a.squared_distance < b.squared_distance);
        return (exact_squared_distance<D>(query, p) - exact_squared_distance<D>(query, q)).sign();
    }
};

/// The k nearest as floats see them, sorted; and whether these are certainly the k nearest.
template <int D>
class FloatNearest {
  public:
    float reach = infinity;

    /// Keeps as many as there are keys.
    explicit FloatNearest(std::span<std::uint64_t> keys) : keys_(keys) {}

    void consider(float distance, std::uint32_t slot) {
        const std::uint64_t key = key_of(distance, slot);
        std::size_t at = found_;
        if (found_ < keys_.size()) {
            ++found_;
        } else {
            const std::uint64_t last = keys_[--at];
            left_out_ = std::min(left_out_, distance_of(std::max(key, last)));
            if (key >= last) return;
        }
        for (; at > 0 && keys_[at - 1] > key; --at) keys_[at] = keys_[at - 1];
        keys_[at] = key;
        if (found_ == keys_.size()) reach = unsure_up_to<D>(distance_of(keys_[found_ - 1]));
    }
    std::span<const std::uint64_t> found() const { return keys_.first(found_); }
    /// Where something left out lies within the reach, doubles must decide.
    bool is_certain() const { return left_out_ > reach; }

    static std::uint32_t slot_of(std::uint64_t key) { return static_cast<std::uint32_t>(key); }

  private:
    /// Distance and slot in one number, to be moved as one. Floats that are not negative have the
    /// order of their bits.
    static std::uint64_t key_of(float distance, std::uint32_t slot) {
        return (std::uint64_t{std::bit_cast<std::uint32_t>(distance)} << 32) | slot;
    }
    static float distance_of(std::uint64_t key) {
        return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32));
    }

    std::span<std::uint64_t> keys_;
    std::size_t found_ = 0;
    float left_out_ = infinity;  ///< the nearest of those that were considered and not kept
};

/// The k nearest in their true order.
template <int D, class Tree>
class TrueNearest {
  public:
    float reach;

    TrueNearest(const TrueOrder<D, Tree>& nearer, std::span<Neighbour> best, float limit)
        : reach(limit), nearer_(nearer), best_(best) {}

    void consider(float, std::uint32_t slot) {
        const Neighbour candidate = nearer_.neighbour(slot);
        std::size_t at = found_;
        if (found_ < best_.size())
            ++found_;
        else if (!nearer_(candidate, best_[--at]))
            return;
        for (; at > 0 && nearer_(candidate, best_[at - 1]); --at) best_[at] = best_[at - 1];
        best_[at] = candidate;
        if (found_ == best_.size())
            reach = std::min(reach, float_reach<D>(best_.back().squared_distance));
    }

  private:
    const TrueOrder<D, Tree>& nearer_;
    std::span<Neighbour> best_;
    std::size_t found_ = 0;
};

/// Finds the k nearest points, query after query. It holds the memory that this takes, so one of
/// these serves one thread.
template <int D, class Search = PointSearch<D>>
class NearestSearch {
  public:
    using Tree = typename Search::Tree;

    NearestSearch(const Tree& tree, std::size_t k)
        : tree_(tree), keys_(std::min(k, tree.size)), best_(keys_.size()) {}

    // [nearest]
    /// The nearest of all first, of equally near ones that with the lower index; all points where
    /// there are fewer than k. Valid until the next query.
    template <class Observer = NoObserver>
    std::span<const Neighbour> operator()(const Point<D>& query, Observer&& observer = {}) {
        if (best_.empty() || !is_finite<D>(query)) return {};
        const TrueOrder<D, Tree> nearer{tree_, query};
        FloatNearest<D> guess(keys_);
        Search::run(tree_, query, guess, observer);
        if (guess.is_certain()) {
            sort_by(nearer, guess.found());
        } else {
            TrueNearest<D, Tree> truth(nearer, best_, guess.reach);
            Search::run(tree_, query, truth, observer);
        }
        nearer.name(best_);
        return best_;
    }
    // [nearest]

  private:
    /// They are in order but for those too close for floats: insertion sort has little to do.
    void sort_by(const TrueOrder<D, Tree>& nearer, std::span<const std::uint64_t> keys) {
        for (std::size_t i = 0; i < keys.size(); ++i) {
            best_[i] = nearer.neighbour(FloatNearest<D>::slot_of(keys[i]));
            for (std::size_t at = i; at > 0 && nearer(best_[at], best_[at - 1]); --at)
                std::swap(best_[at], best_[at - 1]);
        }
    }

    const Tree& tree_;
    std::vector<std::uint64_t> keys_;
    std::vector<Neighbour> best_;
};

/// For a single query; see NearestSearch.
template <int D, class Search = PointSearch<D>>
std::vector<Neighbour> k_nearest(const typename Search::Tree& tree, const Point<D>& query,
                                 std::size_t k) {
    NearestSearch<D, Search> search(tree, k);
    const auto best = search(query);
    return {best.begin(), best.end()};
}

/// Collects all points of a closed ball.
template <int D, class Tree>
class RadiusSearch {
  public:
    const float reach;

    RadiusSearch(const TrueOrder<D, Tree>& nearer, float radius, std::vector<Neighbour>& found)
        : reach(float_reach<D>(square_of(radius))),
          nearer_(nearer),
          square_(square_of(radius)),
          found_(found) {}

    void consider(float, std::uint32_t slot) {
        const Neighbour candidate = nearer_.neighbour(slot);
        const double d = candidate.squared_distance;
        if (certainly_less<D>(d, square_) ||
            (!certainly_less<D>(square_, d) && exactly_within(slot)))
            found_.push_back(candidate);
    }

  private:
    /// Exact: a float has 24 bits. Infinite for an infinite radius.
    static double square_of(float radius) {
        return static_cast<double>(radius) * static_cast<double>(radius);
    }
    bool exactly_within(std::uint32_t slot) const {
        const auto d = exact_squared_distance<D>(nearer_.query, nearer_.tree.point(slot));
        return (d + -square_).sign() <= 0;
    }

    const TrueOrder<D, Tree>& nearer_;
    double square_;
    std::vector<Neighbour>& found_;
};

/// All points whose true distance is at most the radius, in the order of `k_nearest`; none for a
/// negative radius. `found` keeps its memory from query to query.
template <int D, class Search = PointSearch<D>, class Observer = NoObserver>
void within_radius(const typename Search::Tree& tree, const Point<D>& query, float radius,
                   std::vector<Neighbour>& found, Observer&& observer = {}) {
    found.clear();
    if (tree.size == 0 || !is_finite<D>(query) || !(radius >= 0.0f)) return;
    const TrueOrder<D, typename Search::Tree> nearer{tree, query};
    RadiusSearch<D, typename Search::Tree> ball(nearer, radius, found);
    Search::run(tree, query, ball, observer);
    std::sort(found.begin(), found.end(), nearer);
    nearer.name(found);
}

// [within_box]
/// The indices of all points in a closed box, ascending. `found` keeps its memory from query to
/// query.
template <int D, class Observer = NoObserver>
void within_box(const KdPoints<D>& tree, const BasicAabb<D>& box, std::vector<std::uint32_t>& found,
                Observer&& observer = {}) {
    using Search = PointSearch<D>;
    found.clear();
    if (tree.size == 0 || box.is_empty()) return;
    std::array<typename KdPoints<D>::Subtree, 33> waiting;
    std::size_t size = 0;
    waiting[size++] = tree.root();
    while (size > 0) {
        const auto subtree = waiting[--size];
        observer.observe(typename Search::Visited{subtree});
        if (subtree.is_bucket()) {
            const std::size_t first = KdPoints<D>::bucket_size * subtree.first;
            const std::size_t last = std::min(first + KdPoints<D>::bucket_size, tree.size);
            for (auto slot = std::uint32_t(first); slot < last; ++slot) {
                observer.observe(typename Search::Compared{tree.index(slot)});
                if (box.contains(tree.point(slot))) found.push_back(tree.index(slot));
            }
            continue;
        }
        const auto& node = tree.node(subtree);
        const int axis = static_cast<int>(node.axis);
        if (node.right <= box.max[axis])
            waiting[size++] = subtree.right();
        else
            observer.observe(typename Search::Pruned{subtree.right()});
        if (box.min[axis] <= node.left)
            waiting[size++] = subtree.left();
        else
            observer.observe(typename Search::Pruned{subtree.left()});
    }
    std::sort(found.begin(), found.end());
}
// [within_box]

}  // namespace space
