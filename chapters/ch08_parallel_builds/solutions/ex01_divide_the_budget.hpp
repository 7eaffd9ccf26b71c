/// @file
/// Exercise 8.1, our answer.
#pragma once

#include <cstdint>
#include <span>

namespace space {

/// What a node leaves to its children.
struct ChildBudgets {
    unsigned first, second;
};

/// Of a node with two children and a budget of at least 1.
inline ChildBudgets divide_budget(unsigned budget) {
    const unsigned left = budget - 1;
    return {left / 2, left - left / 2};
}

/// How many threads are started at this node and below it. `first_child` tells for each node the
/// first of its two children, which stand side by side, or 0 if it is a leaf.
inline unsigned started_threads(std::span<const std::uint32_t> first_child, std::uint32_t node,
                                unsigned budget) {
    const std::uint32_t child = first_child[node];
    if (budget == 0 || child == 0) return 0;
    const ChildBudgets budgets = divide_budget(budget);
    return 1 + started_threads(first_child, child, budgets.first) +
           started_threads(first_child, child + 1, budgets.second);
}

}  // namespace space
