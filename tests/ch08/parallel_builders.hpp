/// @file
/// The chapter's builders under one type, each compiled once for all of its tests.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace space {

/// Hooks into a build. They are called by many threads at once.
struct Watcher : NoObserver {
    std::function<void(const BvhChosen<3>&)> chosen = {};
    std::function<void(const BvhTaken<3>&)> taken = {};
    std::function<void(unsigned worker)> quits = {};

    using NoObserver::observe;
    void observe(const BvhChosen<3>& event) {
        if (chosen) chosen(event);
    }
    void observe(const BvhTaken<3>& event) {
        if (taken) taken(event);
    }
    void observe(const BvhQuits& event) {
        if (quits) quits(event.worker);
    }
};

/// One of them, with one way to share the work.
struct ParallelBuilder {
    std::string name;
    std::function<BvhNodes<3>(std::span<const Triangle>, const BinnedBuilder::Config&,
                              unsigned threads, Watcher&)>
        build;
};

/// The published methods with all conditions and endings, and ours, with its own limits and with
/// such that small scenes have large nodes, too.
std::vector<ParallelBuilder> parallel_builders();

/// Empty, or what is not the same in two trees: their nodes with their numbers, and the references.
inline std::string difference(const BvhNodes<3>& is, const BvhNodes<3>& expected) {
    if (is.nodes.size() != expected.nodes.size()) return "another number of nodes";
    for (std::size_t i = 0; i < is.nodes.size(); ++i)
        if (is.nodes[i] != expected.nodes[i]) return "node " + std::to_string(i);
    if (is.references != expected.references) return "the references";
    if (is.depth != expected.depth) return "the depth";
    return "";
}

}  // namespace space
