/// @file
/// Where the nodes of a drawn tree stand.
#pragma once

#include "common/geometry.hpp"

#include <cstddef>
#include <vector>

namespace space {

/// x in slots from the left, one for each leaf; y in levels from the root. The root is node 0;
/// children[i] are those of node i from left to right, and a node stands over their middle.
std::vector<Double2> tree_layout(const std::vector<std::vector<std::size_t>>& children);

}  // namespace space
