/// @file
/// Exercise 3.6, a near miss: the near child is the one on the origin's side, and both are visited
/// wherever the line crosses the ray at all; the interval is not cut. Cells come in a right order,
/// and among them some that the ray never enters.
#pragma once

#include "common/geometry.hpp"

#include <limits>
#include <span>
#include <vector>

namespace space {

/// The line dot(normal, p) = offset parts what is left of the plane for this node; its front is
/// where the dot product is larger. A child is the index of a node, or ~c, which is negative, for
/// cell c.
struct CellNode {
    Double2 normal;
    double offset;
    int front, back;
};

inline std::vector<int> cells_along(std::span<const CellNode> nodes, const Double2& origin,
                                    const Double2& direction) {
    struct Task {
        int child;
        double enter, leave;
    };
    std::vector<int> cells;
    std::vector<Task> tasks{{0, 0.0, std::numeric_limits<double>::infinity()}};
    while (!tasks.empty()) {
        const auto [child, enter, leave] = tasks.back();
        tasks.pop_back();
        if (child < 0) {
            cells.push_back(~child);
            continue;
        }
        const CellNode& node = nodes[static_cast<std::size_t>(child)];
        const double height = glm::dot(node.normal, origin) - node.offset;
        const double slope = glm::dot(node.normal, direction);
        if (slope == 0.0) {  // it never crosses
            tasks.push_back({height >= 0.0 ? node.front : node.back, enter, leave});
            continue;
        }
        // Before it crosses, the ray is on the side that it leaves.
        const double t = -height / slope;
        const int near = slope < 0.0 ? node.front : node.back;
        const int far = slope < 0.0 ? node.back : node.front;
        if (t < leave) tasks.push_back({far, enter, leave});
        if (t > enter) tasks.push_back({near, enter, leave});
    }
    return cells;
}

}  // namespace space
