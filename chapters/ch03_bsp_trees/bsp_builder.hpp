/// @file
/// Building a BSP tree: Algorithm 2 of Heinonen16 (section 3.1.1), with a place for coplanar
/// polygons and a choice of splitters.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"
#include "common/pcg32.hpp"
#include "common/zero_area.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// What a builder may choose.
struct BspConfig {
    /// How a node's plane is chosen.
    enum class SplitterChoice {
        first,          ///< the first of the set
        random,         ///< any of the set
        balanced,       ///< of the candidates, the one with |front| nearest to |back|
        fewest_splits,  ///< of the candidates, the one that cuts fewest
        weighted,       ///< of the candidates, the least |front| - |back| + split_weight cuts
        free,  ///< weighted, and where all candidates are lopsided a plane across an axis that no
               ///< polygon lies in
    };
    /// Straddling polygons are cut, or put whole into both subtrees (Heinonen16, section 3.1.1).
    enum class Straddlers { split, share };

    SplitterChoice splitter = SplitterChoice::weighted;
    Straddlers straddlers = Straddlers::split;
    Grade grade = Grade::exact;
    std::uint32_t candidates = 8;  ///< polygons tried for each splitter
    double split_weight = 8.0;     ///< how many polygons of imbalance a cut is worth avoiding
    double lopsided = 0.1;         ///< below this share on the smaller side a free plane is tried
    /// Of planes that aren't exact: times roundoff times the largest coordinate.
    double thickness_in_roundings = 8.0;
    std::uint64_t seed = 1;  ///< of the random choices
    /// Limits memory.
    std::size_t max_fragments = std::numeric_limits<std::uint32_t>::max();
    /// Limits time: polygons that all nodes together may place; n^2 / 2 in a chain.
    std::uint64_t max_placed = std::numeric_limits<std::uint64_t>::max();
    /// Splitters to take first, by polygon, where they are in the set.
    std::span<const std::uint32_t> order = {};
};

/// Makes a tree of polygons and tells an observer each step.
template <int D>
class BspBuilder {
  public:
    /// Event: a node has got its plane, which is that of a polygon unless it is free.
    struct Chosen {
        const SplitPlane<D>& plane;
        std::optional<std::uint32_t> polygon;
        std::uint32_t node, parent;
        bool in_front;  ///< of the parent
    };
    /// Event: where a fragment lies, seen from the node's plane.
    struct Placed {
        const Fragment<D>& fragment;
        PlaneSide side;
    };
    /// Event: a straddling fragment, and its pieces.
    struct Cut {
        const Fragment<D>&whole, &front, &back;
    };

    /// Polygons without extent (equal corners in the plane, zero area in space) are left out: they
    /// hide nothing.
    /// @throws LimitError where the tree would have more than config.max_fragments fragments, or
    /// place more than config.max_placed
    template <class Observer = NoObserver>
    static BspTree<D> build(std::span<const Simplex<D>> polygons, const BspConfig& config = {},
                            Observer&& observer = {}) {
        BspBuilder builder(polygons, config);
        builder.run(observer);
        return std::move(builder.tree_);
    }

  private:
    using Set = std::vector<Fragment<D>>;
    /// A set that waits to become a node.
    struct Task {
        Set set;
        std::uint32_t parent;
        bool in_front;
    };
    struct Splitter {
        SplitPlane<D> plane;
        std::optional<std::uint32_t> polygon;
    };
    /// What a splitter makes of a set.
    struct Tally {
        std::size_t front = 0, back = 0, cuts = 0, coplanar = 0;
    };

    BspBuilder(std::span<const Simplex<D>> polygons, const BspConfig& config)
        : config_(config), random_(config.seed) {
        tree_.polygons.assign(polygons.begin(), polygons.end());
        float largest = 0.0f;
        for (const Simplex<D>& polygon : polygons)
            for (int corner = 0; corner < D; ++corner)
                for (int axis = 0; axis < D; ++axis)
                    largest = std::max(largest, std::abs(polygon[corner][axis]));
        const bool floats =
            config.grade == Grade::thick_float || config.grade == Grade::ordered_float;
        const double roundoff = floats ? 0x1p-24 : double_roundoff;
        thickness_ = config.thickness_in_roundings * roundoff * static_cast<double>(largest);
    }

    // [run]
    template <class Observer>
    void run(Observer& observer) {
        std::vector<Task> tasks;  // not recursion: a chain is as deep as there are polygons
        tasks.push_back({all_polygons(), BspTree<D>::none, false});
        while (!tasks.empty()) {
            Task task = std::move(tasks.back());
            tasks.pop_back();
            if (task.set.empty()) continue;
            const std::uint32_t node = next_node();
            auto [front, back] = make_node(std::move(task), observer);
            tasks.push_back({std::move(back), node, false});
            tasks.push_back({std::move(front), node, true});
        }
    }
    // [run]

    /// What lies in front of a node's plane and behind it.
    struct Parts {
        Set front, back;
    };

    // [make_node]
    /// Algorithm 2 of Heinonen16: chooses a plane, and sends every fragment of the set to the
    /// front, to the back, into the node, or in two pieces to both sides.
    template <class Observer>
    Parts make_node(Task task, Observer& observer) {
        const Splitter splitter = choose(task.set);
        const Cutter<D> cutter = add_node(splitter, task, observer);
        Parts parts;
        for (Fragment<D>& fragment : task.set) {
            const PlaneSide side = side_of(splitter, cutter, fragment);
            observer.observe(Placed{fragment, side});
            switch (side) {
                case PlaneSide::front:
                    parts.front.push_back(std::move(fragment));
                    break;
                case PlaneSide::back:
                    parts.back.push_back(std::move(fragment));
                    break;
                case PlaneSide::coplanar:
                    add_fragment(std::move(fragment));
                    break;
                case PlaneSide::straddling:
                    cut(cutter, fragment, parts, observer);
                    break;
            }
        }
        return parts;
    }
    // [make_node]

    Set all_polygons() {
        Set all;
        for (std::uint32_t i = 0; i < tree_.polygons.size(); ++i)
            if (spans_plane(tree_.polygons[i]))
                all.push_back(whole_polygon<D>(tree_.polygons[i], i));
        count_fragments(all.size());
        return all;
    }

    static bool spans_plane(const Simplex<D>& polygon) {
        if constexpr (D == 2)
            return polygon.a != polygon.b;
        else
            return !has_zero_area(polygon);
    }

    std::uint32_t next_node() const { return static_cast<std::uint32_t>(tree_.nodes.size()); }

    /// Appends the node, links its parent to it, and makes what cuts by its plane.
    template <class Observer>
    Cutter<D> add_node(const Splitter& splitter, const Task& task, Observer& observer) {
        count_placed(task.set.size());
        const std::uint32_t node = next_node();
        if (task.parent != BspTree<D>::none) {
            auto& parent = tree_.nodes[task.parent];
            (task.in_front ? parent.front : parent.back) = node;
        }
        tree_.nodes.push_back({.plane = static_cast<std::uint32_t>(tree_.planes.size()),
                               .first = static_cast<std::uint32_t>(tree_.fragments.size())});
        tree_.planes.push_back(splitter.plane);
        observer.observe(
            Chosen{splitter.plane, splitter.polygon, node, task.parent, task.in_front});
        return {tree_.polygons, tree_.planes, config_.grade, thickness_};
    }

    /// To the newest node.
    void add_fragment(Fragment<D> fragment) {
        tree_.fragments.push_back(std::move(fragment));
        ++tree_.nodes.back().count;
    }

    /// Seen from the newest plane, the splitter's. A piece of the splitter's own polygon lies in
    /// it, whatever rounding says. The sides of the corners stay in sides_.
    PlaneSide side_of(const Splitter& splitter, const Cutter<D>& cutter,
                      const Fragment<D>& fragment) {
        if (fragment.polygon == splitter.polygon) return PlaneSide::coplanar;
        cutter.corner_sides(fragment, newest_plane(), sides_);
        return Cutter<D>::classify(sides_);
    }
    std::uint32_t newest_plane() const {
        return static_cast<std::uint32_t>(tree_.planes.size() - 1);
    }

    template <class Observer>
    void cut(const Cutter<D>& cutter, Fragment<D>& fragment, Parts& parts, Observer& observer) {
        count_fragments(1);
        if (config_.straddlers == BspConfig::Straddlers::share) {
            parts.front.push_back(fragment);
            parts.back.push_back(std::move(fragment));
            return;
        }
        auto [front, back] = cutter.split(fragment, sides_, newest_plane());
        observer.observe(Cut{fragment, front, back});
        // Exact pieces have an extent, even where it is too small for their corners to differ in
        // double.
        const bool exact = config_.grade == Grade::exact;
        if (exact || Cutter<D>::has_extent(front)) parts.front.push_back(std::move(front));
        if (exact || Cutter<D>::has_extent(back)) parts.back.push_back(std::move(back));
    }

    void count_fragments(std::size_t more) {
        fragments_ += more;
        if (fragments_ > config_.max_fragments)
            throw LimitError("BSP tree: more than " + std::to_string(config_.max_fragments) +
                             " fragments (max_fragments)");
    }
    void count_placed(std::size_t more) {
        placed_ += more;
        if (placed_ > config_.max_placed)
            throw LimitError("BSP tree: more than " + std::to_string(config_.max_placed) +
                             " polygons to place (max_placed)");
    }

    Splitter plane_of(const Fragment<D>& fragment) const {
        return {SplitPlane<D>(tree_.polygons[fragment.polygon]), fragment.polygon};
    }
    /// The first of config.order that is in the set.
    std::optional<Splitter> ordered(const Set& set) const {
        for (const std::uint32_t wanted : config_.order)
            for (const Fragment<D>& fragment : set)
                if (fragment.polygon == wanted) return plane_of(fragment);
        return std::nullopt;
    }

    // [choose]
    Splitter choose(const Set& set) {
        using enum BspConfig::SplitterChoice;
        if (const auto wanted = ordered(set)) return *wanted;
        if (config_.splitter == first || set.size() == 1) return plane_of(set.front());
        const auto size = static_cast<std::uint32_t>(set.size());
        if (config_.splitter == random) return plane_of(set[random_.below(size)]);

        std::optional<Splitter> best;
        double best_cost = infinity, best_share = 0.0;
        const auto consider = [&](const Splitter& candidate) {
            const Tally tally = tally_of(candidate, set, best_cost);
            const double cost = cost_of(tally);
            if (cost >= best_cost) return;
            best = candidate;
            best_cost = cost;
            best_share = static_cast<double>(std::min(tally.front, tally.back) + tally.cuts) /
                         static_cast<double>(size);
        };
        const std::uint32_t tries = std::min(std::max(config_.candidates, 1u), size);
        for (std::uint32_t i = 0; i < tries; ++i)  // all of a small set, else one at random
            consider(plane_of(set[size == tries ? i : random_.below(size)]));
        if (config_.splitter == free && best_share < config_.lopsided && size > tries)
            for (int axis = 0; axis < D; ++axis) {
                const Splitter across{axis_plane<D>(axis, middle(set, axis)), std::nullopt};
                const Tally tally = tally_of(across, set);
                if (tally.front > 0 && tally.back > 0) consider(across);
            }
        return *best;
    }
    // [choose]

    /// Counts until the candidate is dearer than `limit`, which it can't undo: cuts never become
    /// fewer.
    Tally tally_of(const Splitter& candidate, const Set& set, double limit = infinity) {
        tree_.planes.push_back(candidate.plane);  // while it is counted
        // Counting a polygon's plane decides nothing that must be exact: doubles do, with a
        // thickness, so that neighbours which touch the plane don't count as cut. But a free plane
        // has to part the set: if only rounding said so, the builder would take the same plane
        // again and again.
        const bool in_double = config_.grade == Grade::exact && candidate.polygon;
        const Cutter<D> counter(tree_.polygons, tree_.planes,
                                in_double ? Grade::ordered_double : config_.grade, thickness_);
        Tally tally;
        for (const Fragment<D>& fragment : set) {
            const PlaneSide side = side_of(candidate, counter, fragment);
            ++(side == PlaneSide::front      ? tally.front
               : side == PlaneSide::back     ? tally.back
               : side == PlaneSide::coplanar ? tally.coplanar
                                             : tally.cuts);
            if (side == PlaneSide::straddling && cost_of({.cuts = tally.cuts}) >= limit) break;
        }
        tree_.planes.pop_back();
        return tally;
    }

    double cost_of(const Tally& tally) const {
        const double imbalance =
            std::abs(static_cast<double>(tally.front) - static_cast<double>(tally.back));
        const auto cuts = static_cast<double>(tally.cuts);
        switch (config_.splitter) {
            case BspConfig::SplitterChoice::balanced:
                return imbalance;
            case BspConfig::SplitterChoice::fewest_splits:
                return cuts;
            default:
                return imbalance + config_.split_weight * cuts;
        }
    }

    /// The median of the fragments' first corners.
    float middle(const Set& set, int axis) const {
        std::vector<double> places;
        for (const Fragment<D>& fragment : set) places.push_back(fragment.corners[0].at[axis]);
        const auto half = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
        std::nth_element(places.begin(), half, places.end());
        return static_cast<float>(*half);
    }

    BspConfig config_;
    Pcg32 random_;
    BspTree<D> tree_;
    double thickness_ = 0.0;
    std::size_t fragments_ = 0;
    std::uint64_t placed_ = 0;
    std::vector<int> sides_;  ///< of the corners of the fragment in hand
};

}  // namespace space
