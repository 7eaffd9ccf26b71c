#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"

#include "common/program/tree_layout.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace space::ch04 {
namespace {

/// Writes the builder's events down.
struct BuildWatcher : NoObserver {
    using NoObserver::observe;
    std::vector<Turn>& turns;

    explicit BuildWatcher(std::vector<Turn>& to) : turns(to) {}

    void observe(const KdBuilder<2>::Chosen& event) {
        Turn turn{event.node, event.depth, event.cell, event.split, {}, {}, {}};
        for (const auto& reference : event.references) turn.set.push_back(reference.polygon);
        turns.push_back(std::move(turn));
    }
    void observe(const KdBuilder<2>::Placed& event) {
        using Half = KdBuilder<2>::Half;
        Turn& turn = turns.back();
        if (event.half != Half::above) turn.below.push_back(event.reference.polygon);
        if (event.half != Half::below) turn.above.push_back(event.reference.polygon);
    }
};

/// Writes the walk's visits down.
struct WalkWatcher {
    std::vector<Visit> visits = {};
    double nearest = infinity;
    void observe(const KdVisit& event) { visits.push_back({event, {}, nearest}); }
};

}  // namespace

const Turn& Story::turn_of(std::uint32_t node) const {
    return *std::ranges::find(turns, node, &Turn::node);
}

Story watched_build(std::span<const Segment> segments, const KdTreeConfig& config) {
    Story story{
        .segments = {segments.begin(), segments.end()}, .named = {}, .tree = {}, .turns = {}};
    for (const Segment& segment : segments)
        story.named.push_back({std::string(1, static_cast<char>('A' + story.named.size() % 26)),
                               Double2(segment.a), Double2(segment.b)});
    BuildWatcher watcher(story.turns);
    story.tree = KdBuilder<2>::build(story.segments, config, watcher);
    story.config = config;
    story.config.planned = {};
    return story;
}

double expected_cost(const Story& story) {
    const SahCosts costs;
    double cost = 0.0;
    for (const Turn& turn : story.turns)
        cost += turn.cell.half_area() *
                (turn.split ? costs.traversal : costs.intersection * double(turn.set.size()));
    return cost / story.tree.box.half_area();
}

std::span<const KdSplit> heinonen_planes() {
    static constexpr KdSplit planes[] = {{0, 8.0f}, {1, 11.5f},  {0, 4.0f},
                                         {1, 6.5f}, {0, 11.25f}, {0, 12.5f}};
    return planes;
}

Story heinonen_story() {
    Story story = watched_build(
        heinonen_segments(),
        {.rule = KdTreeConfig::Rule::middle, .max_leaf_size = 1, .planned = heinonen_planes()});
    story.plane_names = "quvrts";
    return story;
}

std::string heinonen_plane_name(const Story& story, std::uint32_t node) {
    std::size_t inner = 0;
    for (const Turn& turn : story.turns) {
        if (turn.node == node) break;
        inner += turn.split.has_value();
    }
    return std::string(1, story.plane_names[inner]);
}

std::vector<Double2> layout_of(const Story& story) {
    std::vector<std::vector<std::size_t>> children(story.tree.nodes.size());
    for (const Turn& turn : story.turns) {
        const std::size_t below = story.tree.nodes[turn.node].below();
        if (turn.split) children[turn.node] = {below, below + 1};
    }
    return tree_layout(children);
}

ConvexCell corners_of(const Aabb2& box) {
    const Double2 low(box.min), high(box.max);
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

std::array<Double2, 2> line_in_cell(const Aabb2& cell, const KdSplit& split) {
    Double2 from(cell.min), to(cell.max);
    from[split.axis] = to[split.axis] = static_cast<double>(split.position);
    return {from, to};
}

std::string drawn_set(const Story& story, std::span<const std::uint32_t> set) {
    std::string text = "{";
    for (const std::uint32_t i : set)
        text += (text.size() > 1 ? ", " : "") + drawn_name(story.named[i].name);
    return text + "}";
}

std::string plain_set(const Story& story, std::span<const std::uint32_t> set) {
    std::string text = "{";
    for (const std::uint32_t i : set)
        text += (text.size() > 1 ? ", " : "") + plain_name(story.named[i].name);
    return text + "}";
}

std::vector<Visit> watched_walk(const Story& story, const Ray2& ray) {
    WalkWatcher watcher;
    NoCounts none;
    walk_cells(
        story.tree, ray, none,
        [&](std::uint32_t node) {
            Visit& visit = watcher.visits.back();
            for (const std::uint32_t i : story.tree.own(node)) {
                visit.tested.push_back(i);
                watcher.nearest = std::min(watcher.nearest, distance_along(ray, story.segments[i]));
            }
            return visit.nearest = watcher.nearest;
        },
        watcher);
    return watcher.visits;
}

}  // namespace space::ch04
