/// @file
/// Chapter 7's binned build as a graph of tasks: with the time that each node took, or with what a
/// formula of its triangles says.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch08_parallel_builds/task_graph.hpp"
#include "common/geometry.hpp"
#include "common/measure.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

// [task_recorder]
/// Writes down each node that the builder chooses. cost(size, is_leaf) is asked once a node, in the
/// order of the build.
template <int D, class Cost>
struct TaskRecorder : NoObserver {
    TaskGraph graph = {};
    Cost cost;

    explicit TaskRecorder(Cost cost_of) : cost(std::move(cost_of)) {}
    using NoObserver::observe;
    void observe(const BvhChosen<D>& chosen) {
        const BvhTask<D>& task = chosen.task;
        // The builder leaves a gap after the root.
        const std::size_t index = task.node == 0 ? 0 : task.node - 1;
        const std::size_t next = std::max<std::size_t>(graph.nodes.size(), 1);
        if (chosen.cut) graph.nodes.resize(next + 2);
        if (graph.nodes.empty()) graph.nodes.resize(1);
        graph.nodes[index] = {.cost = cost(task.range.size(), !chosen.cut),
                              .triangles = static_cast<std::uint32_t>(task.range.size()),
                              .first = chosen.cut ? static_cast<std::uint32_t>(next) : 0,
                              .depth = task.depth};
    }
};
// [task_recorder]

/// What a node costs by its number of triangles.
struct NodeCost {
    double node, triangle, bin;

    /// Bins are compared for cut nodes, at most 16 an axis, and no more than there are triangles.
    double operator()(std::size_t size, bool is_leaf) const {
        return node + triangle * double(size) +
               (is_leaf ? 0.0 : bin * double(std::min<std::size_t>(size, 16)));
    }
};

/// The graph with costs that are the same on every machine.
template <int D = 3>
TaskGraph counted_tasks(std::span<const Simplex<D>> polygons, const NodeCost& cost,
                        const BinnedBuilder::Config& config = {}) {
    TaskRecorder<D, NodeCost> recorder(cost);
    BinnedBuilder::build<D>(polygons, config, recorder);
    return std::move(recorder.graph);
}

/// The graph with each node's time in nanoseconds: the middle one of several builds, less what
/// reading the clock takes. Joining is what the sequential builder does after its last node.
TaskGraph timed_tasks(std::span<const Triangle> triangles, int rounds,
                      const BinnedBuilder::Config& config = {});

/// A formula for measured costs.
struct CostFormula {
    NodeCost cost = {};
    double largest_error = 0.0;  ///< of a size class's sum, as a share of that; classes of < 1 %
                                 ///< of the work aside
};
/// By least squares of relative errors, over classes of nodes of similar size.
CostFormula fitted_cost(const TaskGraph& graph);

}  // namespace space
