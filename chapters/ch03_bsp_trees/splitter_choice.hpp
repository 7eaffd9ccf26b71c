/// @file
/// Which plane a node of a BSP tree gets: that of one of its polygons, or a free one, by what the
/// plane would make of the node's set.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_config.hpp"
#include "chapters/ch03_bsp_trees/bsp_tree.hpp"
#include "common/pcg32.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace space {

/// A node's plane, which is that of a polygon unless it is free.
template <int D>
struct Splitter {
    SplitPlane<D> plane;
    std::optional<std::uint32_t> polygon;
};

/// Where a fragment lies, seen from a splitter. A piece of the splitter's own polygon lies in its
/// plane, whatever rounding says. The sides of the corners stay in `sides`.
template <int D>
PlaneSide side_of(const Splitter<D>& splitter, const Cutter<D>& cutter, const Fragment<D>& fragment,
                  std::vector<int>& sides) {
    if (fragment.polygon == splitter.polygon) return PlaneSide::coplanar;
    cutter.corner_sides(fragment, splitter.plane, sides);
    return Cutter<D>::classify(sides);
}

/// Chooses the splitters of a tree while it grows.
template <int D>
class SplitterChooser {
  public:
    using Set = std::span<const Fragment<D>>;

    /// `tree` is the one that grows: what its fragments' corners are made of.
    SplitterChooser(const BspTree<D>& tree, const BspConfig& config, double thickness)
        : tree_(tree), config_(config), thickness_(thickness), random_(config.seed) {}

    // [choose]
    Splitter<D> choose(Set set) {
        using enum BspConfig::SplitterChoice;
        if (const auto wanted = ordered(set)) return *wanted;
        if (config_.splitter == first || set.size() == 1) return plane_of(set.front());
        const auto size = static_cast<std::uint32_t>(set.size());
        if (config_.splitter == random) return plane_of(set[random_.below(size)]);

        std::optional<Splitter<D>> best;
        double best_cost = infinity, best_share = 0.0;
        const auto consider = [&](const Splitter<D>& candidate) {
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
                const Splitter<D> across{axis_plane<D>(axis, middle(set, axis)), std::nullopt};
                const Tally tally = tally_of(across, set);
                if (tally.front > 0 && tally.back > 0) consider(across);
            }
        return *best;
    }
    // [choose]

  private:
    /// What a splitter makes of a set.
    struct Tally {
        std::size_t front = 0, back = 0, cuts = 0, coplanar = 0;
    };

    Splitter<D> plane_of(const Fragment<D>& fragment) const {
        return {SplitPlane<D>(tree_.polygons[fragment.polygon]), fragment.polygon};
    }
    /// The first of config.order that is in the set.
    std::optional<Splitter<D>> ordered(Set set) const {
        for (const std::uint32_t wanted : config_.order)
            for (const Fragment<D>& fragment : set)
                if (fragment.polygon == wanted) return plane_of(fragment);
        return std::nullopt;
    }

    /// Counts until the candidate is dearer than `limit`, which it can't undo: cuts never become
    /// fewer.
    Tally tally_of(const Splitter<D>& candidate, Set set, double limit = infinity) {
        // Counting a polygon's plane decides nothing that must be exact: doubles do, with a
        // thickness, so that neighbours which touch the plane don't count as cut. But a free plane
        // has to part the set: if only rounding said so, the builder would take the same plane
        // again and again.
        const bool in_double = config_.grade == Grade::exact && candidate.polygon;
        const Cutter<D> counter(tree_.polygons, tree_.planes,
                                in_double ? Grade::ordered_double : config_.grade, thickness_);
        Tally tally;
        for (const Fragment<D>& fragment : set) {
            const PlaneSide side = side_of(candidate, counter, fragment, sides_);
            ++(side == PlaneSide::front      ? tally.front
               : side == PlaneSide::back     ? tally.back
               : side == PlaneSide::coplanar ? tally.coplanar
                                             : tally.cuts);
            if (side == PlaneSide::straddling && cost_of({.cuts = tally.cuts}) >= limit) break;
        }
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
    float middle(Set set, int axis) const {
        std::vector<double> places;
        for (const Fragment<D>& fragment : set) places.push_back(fragment.corners[0].at[axis]);
        const auto half = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
        std::nth_element(places.begin(), half, places.end());
        return static_cast<float>(*half);
    }

    const BspTree<D>& tree_;
    BspConfig config_;
    double thickness_;
    Pcg32 random_;
    std::vector<int> sides_;  ///< of the corners of the fragment in hand
};

}  // namespace space
