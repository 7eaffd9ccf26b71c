/// @file
/// Exercise 3.6: Front to back
/// Difficulty 2 of 3, about 35 minutes.
///
/// Return the numbers of the cells that a ray passes through, in the order in which it does. The
/// ray is the points *origin* + *t* *direction* with *t* >= 0. Carry with each node the interval of
/// *t* in which the ray is in its part of the plane: where it crosses the node's line within that
/// interval it passes through both children, else through one. A cell that the ray only touches, or
/// whose border it runs along, may be named or not; a ray in a node's line must not be lost
/// altogether.
#pragma once

#include "common/geometry.hpp"

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
    // TODO: these are all cells, whatever the ray does
    static_cast<void>(origin);
    static_cast<void>(direction);
    std::vector<int> cells;
    for (const CellNode& node : nodes)
        for (const int child : {node.front, node.back})
            if (child < 0) cells.push_back(~child);
    return cells;
}

}  // namespace space
