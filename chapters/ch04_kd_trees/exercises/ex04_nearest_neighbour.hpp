/// @file
/// Exercise 4.4: The nearest point
/// Difficulty 2 of 3, about 30 minutes.
///
/// Find the point nearest to a query in a k-d tree with one point a leaf. Go down to the leaf on
/// the query's side first. On the way back look at the other side too, but only where it may hold a
/// nearer point: where its line is no farther from the query than the best point so far. Of equally
/// near points the lower index wins. The check sees for which points you ask `distance`: no more
/// than such a search needs. All numbers are small, and whole or half, so squared distances are
/// exact.
#pragma once

#include "common/geometry.hpp"

#include <functional>
#include <span>
#include <vector>

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

inline int nearest_point(std::span<const PointNode> nodes, int root, const Point2& query,
                         const Distance& distance) {
    // TODO: this asks for every point of the tree
    static_cast<void>(query);
    int best = -1;
    std::vector<int> to_visit{root};
    while (!to_visit.empty()) {
        const int child = to_visit.back();
        to_visit.pop_back();
        if (child >= 0) {
            to_visit.push_back(nodes[static_cast<std::size_t>(child)].below);
            to_visit.push_back(nodes[static_cast<std::size_t>(child)].above);
            continue;
        }
        const double d = distance(~child);
        if (best == -1 || d < distance(best) || (d == distance(best) && ~child < best))
            best = ~child;
    }
    return best;
}

}  // namespace space
