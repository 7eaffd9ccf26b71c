#include "chapters/ch03_bsp_trees/figures/recorded_walk.hpp"

#include "common/program/walk_drawing.hpp"

#include <algorithm>

namespace space::ch03 {
namespace {

/// Writes the events down.
struct WalkWatcher {
    std::vector<WalkEvent> events = {};
    void observe(const WalkEvent& event) { events.push_back(event); }
};

}  // namespace

double hit_in(const BspTree<2>& tree, std::uint32_t node, const BasicRay<2>& ray) {
    double nearest = infinity;
    for (std::uint32_t i = 0; i < tree.nodes[node].count; ++i) {
        const std::uint32_t polygon = tree.fragments[tree.nodes[node].first + i].polygon;
        nearest = std::min(nearest, distance_along(ray, tree.polygons[polygon]));
    }
    return nearest;
}

std::vector<WalkEvent> watched_walk(const BspTree<2>& tree, const BasicRay<2>& ray) {
    WalkWatcher watcher;
    NoCounts none;
    double nearest = infinity;
    front_to_back(
        tree, ray, none,
        [&](const BspTree<2>::Node& node) {
            const auto index = static_cast<std::uint32_t>(&node - tree.nodes.data());
            return nearest = std::min(nearest, hit_in(tree, index, ray));
        },
        watcher);
    return watcher.events;
}

}  // namespace space::ch03
