/// @file
/// When to build a tree anew that has been refitted frame after frame: rules that look back, and
/// the best that anybody can do who knows all frames.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace space {

// [motion_costs]
/// What frames cost, all in one unit: that of a triangle test, or a millisecond.
struct MotionCosts {
    double build = 0.0;  ///< a tree anew
    double refit = 0.0;  ///< its boxes anew
    /// traced[b][f - b]: all rays of frame f, in the tree that was built in frame b.
    std::vector<std::vector<double>> traced;
    /// The same for the expected cost of a ray, by surface areas.
    std::vector<std::vector<double>> expected;

    std::size_t frames() const { return traced.size(); }
};

/// In which frames the tree is built anew; in the first one always.
using Rebuilds = std::vector<bool>;

/// What all frames cost together.
inline double total_cost(const MotionCosts& costs, const Rebuilds& rebuilds) {
    double total = 0.0;
    std::size_t built = 0;
    for (std::size_t frame = 0; frame < costs.frames(); ++frame) {
        if (rebuilds[frame]) built = frame;
        total += (rebuilds[frame] ? costs.build : costs.refit) + costs.traced[built][frame - built];
    }
    return total;
}
// [motion_costs]

// [policies]
/// What is known of a tree when a frame begins.
struct TreeAge {
    std::size_t frames = 0;       ///< since it was built
    double expected_first = 0.0;  ///< cost of a ray, when it was built
    double expected = 0.0;        ///< cost of a ray, in the last frame
    double excess = 0.0;          ///< what all its frames' rays cost more than its first frame's
};

/// After so many frames.
struct RebuildEvery {
    std::size_t frames;
    bool operator()(const TreeAge& age) const { return age.frames >= frames; }
};

/// Where a ray has become so many times dearer than it was (Lauterbach, Yoon, Tuft & Manocha 2006,
/// "RT-DEFORM: Interactive ray tracing of dynamic scenes using BVHs", by another measure of it).
struct RebuildByCost {
    double factor;
    bool operator()(const TreeAge& age) const { return age.expected > factor * age.expected_first; }
};

/// Where rays have lost by the old tree what a new one costs: as who rents skis buys them when the
/// rent has reached their price (Karlin, Manasse, Rudolph & Sleator 1988, "Competitive snoopy
/// caching").
struct RebuildByExcess {
    double build, refit;
    bool operator()(const TreeAge& age) const { return age.excess >= build - refit; }
};
// [policies]

// [decided]
/// The frames in which a policy builds anew.
template <class Policy>
Rebuilds decided(const Policy& policy, const MotionCosts& costs) {
    Rebuilds rebuilds(costs.frames());
    std::size_t built = 0;
    TreeAge age;
    for (std::size_t frame = 0; frame < costs.frames(); ++frame) {
        age.frames = frame - built;
        rebuilds[frame] = frame == 0 || policy(age);
        if (rebuilds[frame]) {
            built = frame;
            age = {.frames = 0, .expected_first = costs.expected[frame][0]};
        }
        age.expected = costs.expected[built][frame - built];
        age.excess += costs.traced[built][frame - built] - costs.traced[built][0];
    }
    return rebuilds;
}
// [decided]

// [best_in_hindsight]
/// The rebuilds by which all frames cost least, found from the last frame back: least[b] is what
/// frames b, b + 1, ... cost at least when a tree is built in frame b. It is in use until the next
/// one is built, and every frame may be that.
inline Rebuilds best_in_hindsight(const MotionCosts& costs) {
    const std::size_t frames = costs.frames();
    std::vector<double> least(frames + 1, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> next(frames + 1, frames);
    least[frames] = 0.0;
    for (std::size_t b = frames; b-- > 0;) {
        double used = costs.build;
        for (std::size_t end = b + 1; end <= frames; ++end) {
            used += costs.traced[b][end - 1 - b] + (end - 1 > b ? costs.refit : 0.0);
            if (used + least[end] < least[b]) {
                least[b] = used + least[end];
                next[b] = end;
            }
        }
    }
    Rebuilds rebuilds(frames);
    for (std::size_t b = 0; b < frames; b = next[b]) rebuilds[b] = true;
    return rebuilds;
}
// [best_in_hindsight]

}  // namespace space
