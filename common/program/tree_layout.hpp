/// @file
/// Where the nodes of a drawn tree stand.
#pragma once

#include "common/program/svg.hpp"

#include <cstddef>
#include <vector>

namespace space {

/// x in slots from the left, one for each leaf; y in levels from the root. The root is node 0;
/// children[i] are those of node i from left to right, and a node stands over their middle.
std::vector<Double2> tree_layout(const std::vector<std::vector<std::size_t>>& children);

/// Where a layout stands on the paper of a step-through, right of the plane.
struct TreePaper {
    /// `levels` is the deepest one's y; the root stands at the top of a frame of this corner and
    /// size.
    TreePaper(double leaves, double levels, const Double2& corner = {362, 32},
              const Double2& size = {306, 296});
    explicit TreePaper(const std::vector<Double2>& layout, const Double2& corner = {362, 32},
                       const Double2& size = {306, 296});
    Point2 operator()(const Double2& place) const;
    /// A length of a node.
    double shrunk(double length) const { return length * shrink; }

    Double2 corner;
    double slot, level;  ///< in drawing units
    double shrink;       ///< of the nodes, where they would touch: at most 1
};

}  // namespace space
