/// @file
/// Exercise 4.4, our answer.
#pragma once

#include "common/geometry.hpp"

#include <functional>
#include <limits>
#include <span>

namespace space {

/// The line x[axis] = at parts what is left of the plane: `below` holds points whose coordinate is
/// at most `at`, `above` those whose coordinate is at least `at`. A child is the index of a node,
/// or ~p, which is negative, for the point p.
struct PointNode {
    int axis;
    double at;
    int below, above;
};

/// The squared distance from the query to point p.
using Distance = std::function<double(int p)>;

/// Carries the best so far through the tree.
struct NearestPoint {
    std::span<const PointNode> nodes;
    const Point2& query;
    const Distance& distance;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();

    void visit(int child) {
        if (child < 0) {
            const double d = distance(~child);
            if (d < least || (d == least && ~child < best)) {
                best = ~child;
                least = d;
            }
            return;
        }
        const PointNode& node = nodes[static_cast<std::size_t>(child)];
        const double gap = static_cast<double>(query[node.axis]) - node.at;
        visit(gap <= 0.0 ? node.below : node.above);
        if (gap * gap <= least) visit(gap <= 0.0 ? node.above : node.below);
    }
};

inline int nearest_point(std::span<const PointNode> nodes, int root, const Point2& query,
                         const Distance& distance) {
    NearestPoint search{nodes, query, distance};
    search.visit(root);
    return search.best;
}

}  // namespace space
