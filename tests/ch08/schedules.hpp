/// @file
/// What tests of simulated builds share: small graphs, and what must be true of every schedule.
#pragma once

#include "chapters/ch08_parallel_builds/simulator.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace space {

/// A full tree: `levels` levels, each of `per_level` in all; the leaves hold 100 triangles each.
inline TaskGraph balanced_tree(unsigned levels, double per_level) {
    TaskGraph graph;
    for (unsigned level = 0; level < levels; ++level)
        for (std::uint32_t i = 0; i < 1u << level; ++i) {
            const auto index = static_cast<std::uint32_t>(graph.nodes.size());
            const bool is_leaf = level + 1 == levels;
            graph.nodes.push_back({.cost = per_level / double(1u << level),
                                   .triangles = 100u << (levels - 1 - level),
                                   .first = is_leaf ? 0 : 2 * index + 1,
                                   .depth = level});
        }
    return graph;
}

/// Inner nodes that cost 1 each, below one another; beside each but the first a leaf for nothing.
inline TaskGraph chain(unsigned inner) {
    TaskGraph graph;
    graph.nodes.resize(1);
    std::uint32_t parent = 0;
    for (unsigned i = 0; i < inner; ++i) {
        const auto first = static_cast<std::uint32_t>(graph.nodes.size());
        graph.nodes.resize(first + 2, {.cost = 0.0, .triangles = 1, .depth = i + 1});
        graph.nodes[parent] = {.cost = 1.0, .triangles = inner + 1 - i, .first = first, .depth = i};
        parent = first + 1;
    }
    return graph;
}

/// "", or what is wrong: a core does two things at once, a node is made twice, before its parent or
/// not at all, or something lasts into the past.
inline std::string faults_of(const Schedule& schedule, const TaskGraph& graph) {
    using Doing = CoreRun::Doing;
    std::vector<double> busy_until(schedule.cores, 0.0);
    std::vector<double> begins(graph.nodes.size(), -1.0), ends(graph.nodes.size(), -1.0);
    const auto make = [&](std::uint32_t node, const CoreRun& run) {
        if (ends[node] >= 0.0) return false;
        if (begins[node] < 0.0) begins[node] = run.begin;
        ends[node] = run.end;
        return true;
    };
    for (const CoreRun& run : schedule.runs) {
        if (run.core >= schedule.cores) return "no such core";
        if (run.end < run.begin || run.end > schedule.makespan) return "out of time";
        if (run.begin < busy_until[run.core]) return "two things at once";
        busy_until[run.core] = run.end;
        if (run.doing == Doing::chunk && begins[run.node] < 0.0) begins[run.node] = run.begin;
        if (run.doing == Doing::node && !make(run.node, run)) return "made twice";
        if (run.doing != Doing::subtree) continue;
        std::vector<std::uint32_t> waiting{run.node};
        while (!waiting.empty()) {
            const std::uint32_t node = waiting.back();
            waiting.pop_back();
            if (!make(node, run)) return "made twice";
            // Within a subtree the order is the recursion's.
            if (node != run.node) begins[node] = run.end;
            if (graph.nodes[node].is_leaf()) continue;
            waiting.push_back(graph.nodes[node].first);
            waiting.push_back(graph.nodes[node].first + 1);
        }
    }
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        if (ends[i] < 0.0) return "not made";
        if (graph.nodes[i].is_leaf()) continue;
        for (const std::uint32_t child : {graph.nodes[i].first, graph.nodes[i].first + 1})
            if (begins[child] < ends[i]) return "a child before its parent";
    }
    return "";
}

}  // namespace space
