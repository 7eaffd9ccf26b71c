/// @file
/// Exercise 8.1, a near miss: whole-number division by two for both children, which is right for
/// odd budgets, and those of 2, 4, 8 and 16 cores are odd. An even one starts a thread too many.
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
    return {budget / 2, budget / 2};
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
