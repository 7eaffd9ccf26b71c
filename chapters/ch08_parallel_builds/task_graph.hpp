/// @file
/// A build as work: what each node costs, and which nodes have to wait for it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace space {

// [task_graph]
/// A node that a builder makes, as work.
struct TaskNode {
    double cost = 0.0;            ///< of the node alone: to bin, compare and part its triangles
    std::uint32_t triangles = 0;  ///< below it
    std::uint32_t first = 0;      ///< of two children, side by side; 0: a leaf
    std::uint32_t depth = 0;      ///< edges from the root

    bool is_leaf() const { return first == 0; }
};

/// What a build has to do. Children can be made once their parent is; nothing else orders nodes.
/// Costs are in one unit, nanoseconds where they were measured.
struct TaskGraph {
    std::vector<TaskNode> nodes;  ///< the root, then pairs of siblings, parents before children
    double boxing = 0.0;          ///< before the root: a box around each triangle
    double joining = 0.0;         ///< after the last node: one tree of all parts

    /// All that is to do, and so the time of one core.
    double total() const {
        double sum = boxing + joining;
        for (const TaskNode& node : nodes) sum += node.cost;
        return sum;
    }
};

/// By node: the cost of all that is at and below it.
inline std::vector<double> subtree_costs(const TaskGraph& graph) {
    std::vector<double> costs(graph.nodes.size());
    for (std::size_t i = costs.size(); i-- > 0;) {
        const TaskNode& node = graph.nodes[i];
        costs[i] = node.cost;
        if (!node.is_leaf()) costs[i] += costs[node.first] + costs[node.first + 1];
    }
    return costs;
}

/// The dearest way from the start to the end, along which each task waits for the one before: no
/// number of cores is faster (while a node is made by one core).
inline double critical_path(const TaskGraph& graph) {
    std::vector<double> below(graph.nodes.size());
    for (std::size_t i = below.size(); i-- > 0;) {
        const TaskNode& node = graph.nodes[i];
        below[i] = node.cost;
        if (!node.is_leaf()) below[i] += std::max(below[node.first], below[node.first + 1]);
    }
    return graph.boxing + graph.joining + (below.empty() ? 0.0 : below.front());
}
// [task_graph]

}  // namespace space
