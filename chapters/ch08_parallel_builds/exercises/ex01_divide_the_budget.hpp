/// @file
/// Exercise 8.1: Divide the budget of cores
/// Difficulty 1 of 3, about 25 minutes.
///
/// The symmetric method is given a *budget*: how many threads may be started at a node and below
/// it. With *P* cores the root has a budget of *P* - 1, as one thread is there already. A node with
/// a budget starts one thread, for its first child, and its own thread goes on with the second.
/// What is left of the budget is halved. If it is odd, the second child gets one more: its thread
/// is at work already. A leaf starts nothing, whatever its budget: nobody else gets it.
///
/// Write the rule, and count how many threads a tree gets. Trees may have millions of nodes and
/// long chains: look only where there is a budget. The check tries all small budgets and the
/// largest, full trees, chains and random trees, and plays these by the chapter's simulator.
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
    // TODO: one thread is for this node
    return {budget / 2, budget / 2};
}

/// How many threads are started at this node and below it. `first_child` tells for each node the
/// first of its two children, which stand side by side, or 0 if it is a leaf.
inline unsigned started_threads(std::span<const std::uint32_t> first_child, std::uint32_t node,
                                unsigned budget) {
    // TODO: only a node with children starts one, and its children may start more
    static_cast<void>(first_child);
    static_cast<void>(node);
    return budget;
}

}  // namespace space
