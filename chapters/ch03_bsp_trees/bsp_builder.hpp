/// @file
/// Building a BSP tree: Algorithm 2 of Heinonen16 (section 3.1.1), with a place for coplanar
/// polygons and a choice of splitters.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"
#include "common/pcg32.hpp"
#include "common/program/error.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

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

/// Crossing polygons are cut, or put whole into both subtrees (Heinonen16, section 3.1.1).
enum class Straddlers { split, share };

/// What a builder may choose.
struct BspConfig {
    SplitterChoice splitter = SplitterChoice::weighted;
    Straddlers straddlers = Straddlers::split;
    Grade grade = Grade::exact;
    std::uint32_t candidates = 8;  ///< polygons tried for each splitter
    double split_weight = 8.0;     ///< how many polygons of imbalance a cut is worth avoiding
    double lopsided = 0.1;         ///< below this share on the smaller side a free plane is tried
    double thickness_in_roundings =
        8.0;  ///< of planes that aren't exact: times roundoff times the largest coordinate
    std::uint64_t seed = 1;  ///< of the random choices
    std::size_t max_fragments = std::numeric_limits<std::uint32_t>::max();  ///< memory
    std::uint64_t max_placed =
        std::numeric_limits<std::uint64_t>::max();  ///< time: polygons put somewhere by all nodes;
                                                    ///< n^2 / 2 in a chain
    std::span<const std::uint32_t> order =
        {};  ///< splitters to take first, by polygon, where they are in the set
};

/// What a builder tells whoever watches: nothing, to nobody. An observer has these three; one that
/// needs fewer inherits the rest.
struct NoBspObserver {
    template <int D>
    void chosen(const SplitPlane<D>&, std::optional<std::uint32_t> /*polygon*/,
                std::int32_t /*node*/, std::int32_t /*parent*/, bool /*in front of it*/) {}
    template <int D>
    void placed(const Fragment<D>&, Side) {}
    template <int D>
    void cut(const Fragment<D>& /*whole*/, const Fragment<D>& /*front*/,
             const Fragment<D>& /*back*/) {}
};

/// The builder: makes a tree of polygons and tells an observer each step.
template <int D, class Observer = NoBspObserver>
class BspBuilder {
  public:
    /// Polygons without extent (equal corners in the plane, zero area in space) are left out: they
    /// hide nothing.
    /// @throws Error where the tree would have more than config.max_fragments fragments, or place
    /// more than config.max_placed
    static BspTree<D> build(std::span<const Corners<D>> polygons, const BspConfig& config = {},
                            Observer&& observer = {}) {
        BspBuilder builder(polygons, config, observer);
        builder.run();
        return std::move(builder.tree_);
    }

  private:
    using Set = std::vector<Fragment<D>>;
    struct Task {
        Set set;
        std::int32_t parent;
        bool in_front;
    };
    struct Candidate {
        SplitPlane<D> plane;
        std::optional<std::uint32_t> polygon;
    };
    struct Tally {
        std::size_t front = 0, back = 0, cuts = 0, on = 0;
    };

    BspBuilder(std::span<const Corners<D>> polygons, const BspConfig& config, Observer& observer)
        : config_(config), observer_(observer), random_(config.seed) {
        tree_.polygons.assign(polygons.begin(), polygons.end());
        float largest = 0.0f;
        for (const Corners<D>& polygon : polygons)
            for (const Point<D>& corner : polygon)
                for (int axis = 0; axis < D; ++axis)
                    largest = std::max(largest, std::abs(corner[axis]));
        const bool floats =
            config.grade == Grade::thick_float || config.grade == Grade::ordered_float;
        const double roundoff = floats ? 0x1p-24 : 0x1p-53;
        thickness_ = config.thickness_in_roundings * roundoff * static_cast<double>(largest);
    }

    // [run]
    void run() {
        Set all;
        for (std::uint32_t i = 0; i < tree_.polygons.size(); ++i)
            if (spans_plane(tree_.polygons[i]))
                all.push_back(whole_polygon<D>(tree_.polygons[i], i));
        count_fragments(all.size());
        std::vector<Task> tasks;  // not recursion: a chain is as deep as there are polygons
        tasks.push_back({std::move(all), BspTree<D>::none, false});
        while (!tasks.empty()) {
            Task task = std::move(tasks.back());
            tasks.pop_back();
            if (task.set.empty()) continue;
            auto [node, front, back] = make_node(std::move(task.set), task.parent, task.in_front);
            tasks.push_back({std::move(back), node, false});
            tasks.push_back({std::move(front), node, true});
        }
    }
    // [run]

    struct Parts {
        std::int32_t node;
        Set front, back;
    };

    // [make_node]
    /// Chooses a plane, and sends every polygon of the set to the front, the back, both in two
    /// pieces, or into the node.
    Parts make_node(Set set, std::int32_t parent, bool in_front) {
        placed_ += set.size();
        if (placed_ > config_.max_placed)
            throw usage_error(
                fmt::format("BSP tree: more than {} polygons to place; allow more, or try free "
                            "planes, which make "
                            "no chains",
                            config_.max_placed));
        const auto number = static_cast<std::uint32_t>(tree_.planes.size());
        const Candidate splitter = choose(set);
        tree_.planes.push_back(splitter.plane);
        Parts parts{static_cast<std::int32_t>(tree_.nodes.size()), {}, {}};
        observer_.chosen(splitter.plane, splitter.polygon, parts.node, parent, in_front);
        if (parent != BspTree<D>::none) {
            auto& link = tree_.nodes[static_cast<std::size_t>(parent)];
            (in_front ? link.front : link.back) = parts.node;
        }
        const auto first = static_cast<std::uint32_t>(tree_.fragments.size());

        const Splitter<D> cutter(tree_.polygons, tree_.planes, config_.grade, thickness_);
        std::vector<int> sides;
        for (Fragment<D>& fragment : set) {
            const Side place = place_of(cutter, fragment, splitter, number, sides);
            observer_.placed(fragment, place);
            switch (place) {
                case Side::front:
                    parts.front.push_back(std::move(fragment));
                    break;
                case Side::back:
                    parts.back.push_back(std::move(fragment));
                    break;
                case Side::on:
                    tree_.fragments.push_back(std::move(fragment));
                    break;
                case Side::across:
                    cut(cutter, fragment, sides, number, parts);
                    break;
            }
        }
        const auto last = static_cast<std::uint32_t>(tree_.fragments.size());
        tree_.nodes.push_back({number, BspTree<D>::none, BspTree<D>::none, first, last - first});
        return parts;
    }
    // [make_node]

    /// A piece of the splitter's own polygon lies on its plane, whatever rounding says.
    static Side place_of(const Splitter<D>& splitter, const Fragment<D>& fragment,
                         const Candidate& candidate, std::uint32_t plane, std::vector<int>& sides) {
        if (fragment.polygon == candidate.polygon) return Side::on;
        splitter.classify(fragment, plane, sides);
        return Splitter<D>::place(sides);
    }

    void cut(const Splitter<D>& cutter, Fragment<D>& fragment, std::span<const int> sides,
             std::uint32_t plane, Parts& parts) {
        count_fragments(1);
        if (config_.straddlers == Straddlers::share) {
            parts.front.push_back(fragment);
            parts.back.push_back(std::move(fragment));
            return;
        }
        auto [front, back] = cutter.split(fragment, sides, plane);
        observer_.cut(fragment, front, back);
        // Exact pieces have an extent, even where it is too small for their corners to differ in
        // double.
        const bool exact = config_.grade == Grade::exact;
        if (exact || Splitter<D>::has_extent(front)) parts.front.push_back(std::move(front));
        if (exact || Splitter<D>::has_extent(back)) parts.back.push_back(std::move(back));
    }

    void count_fragments(std::size_t more) {
        count_ += more;
        if (count_ > config_.max_fragments)
            throw usage_error(fmt::format(
                "BSP tree: more than {} fragments; allow more, or choose splitters that cut less",
                config_.max_fragments));
    }

    static bool spans_plane(const Corners<D>& polygon) {
        if constexpr (D == 2)
            return polygon[0] != polygon[1];
        else
            return !is_on_a_line(polygon);
    }

    Candidate polygon_plane(const Fragment<D>& fragment) const {
        return {SplitPlane<D>(tree_.polygons[fragment.polygon]), fragment.polygon};
    }

    // [choose]
    Candidate choose(const Set& set) {
        for (const std::uint32_t wanted : config_.order)
            for (const Fragment<D>& fragment : set)
                if (fragment.polygon == wanted) return polygon_plane(fragment);
        if (config_.splitter == SplitterChoice::first || set.size() == 1)
            return polygon_plane(set.front());
        const auto size = static_cast<std::uint32_t>(set.size());
        if (config_.splitter == SplitterChoice::random)
            return polygon_plane(set[random_.below(size)]);

        std::optional<Candidate> best;
        double best_price = infinity, best_share = 0.0;
        const auto consider = [&](const Candidate& candidate) {
            const Tally tally = tally_of(candidate, set, best_price);
            const double price = price_of(tally);
            if (price >= best_price) return;
            best = candidate;
            best_price = price;
            best_share = static_cast<double>(std::min(tally.front, tally.back) + tally.cuts) /
                         static_cast<double>(size);
        };
        const std::uint32_t tries = std::min(std::max(config_.candidates, 1u), size);
        for (std::uint32_t i = 0; i < tries; ++i)  // all of a small set, else one at random
            consider(polygon_plane(set[size == tries ? i : random_.below(size)]));
        if (config_.splitter == SplitterChoice::free && best_share < config_.lopsided &&
            size > tries)
            for (int axis = 0; axis < D; ++axis) {
                const Candidate across{axis_plane<D>(axis, middle(set, axis)), std::nullopt};
                const Tally tally = tally_of(across, set);
                if (tally.front > 0 && tally.back > 0) consider(across);
            }
        return *best;
    }
    // [choose]

    /// Counts until the candidate is dearer than `limit`, which it can't undo: cuts never become
    /// fewer.
    Tally tally_of(const Candidate& candidate, const Set& set, double limit = infinity) {
        const auto number = static_cast<std::uint32_t>(tree_.planes.size());
        tree_.planes.push_back(candidate.plane);  // while it is counted
        // Counting a polygon's plane decides nothing that must be exact: doubles do, with a
        // thickness, so that neighbours which touch the plane don't count as cut. But a free plane
        // has to part the set: if only rounding said so, the builder would take the same plane
        // again and again.
        const bool in_double = config_.grade == Grade::exact && candidate.polygon;
        const Splitter<D> counter(tree_.polygons, tree_.planes,
                                  in_double ? Grade::ordered_double : config_.grade, thickness_);
        Tally tally;
        for (const Fragment<D>& fragment : set) {
            const Side place = place_of(counter, fragment, candidate, number, sides_);
            ++(place == Side::front  ? tally.front
               : place == Side::back ? tally.back
               : place == Side::on   ? tally.on
                                     : tally.cuts);
            if (place == Side::across && price_of({.cuts = tally.cuts}) >= limit) break;
        }
        tree_.planes.pop_back();
        return tally;
    }

    double price_of(const Tally& tally) const {
        const double imbalance =
            std::abs(static_cast<double>(tally.front) - static_cast<double>(tally.back));
        const auto cuts = static_cast<double>(tally.cuts);
        switch (config_.splitter) {
            case SplitterChoice::balanced:
                return imbalance;
            case SplitterChoice::fewest_splits:
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
    Observer& observer_;
    Pcg32 random_;
    BspTree<D> tree_;
    double thickness_ = 0.0;
    std::size_t count_ = 0;  ///< of fragments
    std::uint64_t placed_ = 0;
    std::vector<int> sides_;
};

}  // namespace space
