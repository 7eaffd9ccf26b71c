// A ray's walk through a quadtree of segments, step by step: what the walk told its observer
// becomes the steps of a drawing.

#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures/plane_cells.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_builder.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_walk.hpp"
#include "common/program/walk_drawing.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch06 {
namespace {

/// The segments A to G, moved so that their root's cell is the square from (0, 0) to (16, 16).
std::vector<Segment> moved_segments() {
    std::vector<Segment> segments = heinonen_segments();
    for (Segment& segment : segments) {
        segment.a -= Vector2(1.25f, 1.0f);
        segment.b -= Vector2(1.25f, 1.0f);
    }
    return segments;
}

/// The tree, the cells of its nodes, and what a ray met in it.
struct Story {
    struct Visit {
        OrthtreeVisit<2> at;
        std::vector<std::size_t> tested = {};
        double nearest;  ///< after this node
    };
    std::vector<Segment> segments = moved_segments();
    OrthtreeNodes<2> tree = OrthtreeBuilder<2>::build(
        segments,
        {.costs = {.traversal = 0.0}, .max_leaf_size = 1, .max_depth = 2, .max_growth = 16});
    std::vector<OrthtreeCell<2>> cells = cells_of(tree);
    std::vector<Visit> visits = {};

    explicit Story(const Ray2& ray) {
        struct Watcher {
            std::vector<Visit>& visits;
            double nearest = infinity;
            void observe(const OrthtreeVisit<2>& at) { visits.push_back({at, {}, nearest}); }
        } watcher{visits};
        NoCounts none;
        walk_orthtree(
            tree, OctreeConfig::Walk::parametric, ray, none,
            [&](std::uint32_t node) {
                for (const std::uint32_t i : tree.own(node)) {
                    visits.back().tested.push_back(i);
                    watcher.nearest = std::min(watcher.nearest, distance_along(ray, segments[i]));
                }
                return visits.back().nearest = watcher.nearest;
            },
            watcher);
    }

    /// By the numbers of children, from the root down.
    std::string called(std::size_t node) const {
        std::string path;
        for (std::uint32_t depth = 1; depth <= cells[node].depth; ++depth)
            path += static_cast<char>('0' + cells[node].ancestor(depth).orthant());
        return path.empty() ? "root" : path;
    }
    std::string set_of(std::size_t node) const {
        std::string names;
        for (const std::uint32_t i : tree.own(static_cast<std::uint32_t>(node)))
            names += static_cast<char>('A' + i);
        return names;
    }

  private:
    static std::vector<OrthtreeCell<2>> cells_of(const OrthtreeNodes<2>& tree) {
        std::vector<OrthtreeCell<2>> cells(tree.nodes.size());
        tree.for_each_cell(
            [&](std::uint32_t index, const OrthtreeCell<2>& cell) { cells[index] = cell; });
        return cells;
    }
};

DrawnTree drawn(const Story& story) {
    DrawnTree tree{.size = story.tree.frame.edge, .segments = {}, .nodes = {}};
    for (std::size_t i = 0; i < story.segments.size(); ++i)
        tree.segments.push_back({std::string(1, static_cast<char>('A' + i)),
                                 Double2(story.segments[i].a), Double2(story.segments[i].b)});
    for (std::size_t i = 0; i < story.cells.size(); ++i) {
        const OrthtreeNode& node = story.tree.nodes[i];
        const OrthtreeBox<2> box = story.tree.frame.box(story.cells[i]);
        DrawnTree::Node shown{.name = "", .cell = corners_of(box)};
        if (node.is_leaf()) {
            shown.name = "*" + story.set_of(i) + "*";
        } else {
            const Double2 middle = box.centre();
            shown.name = i == 0 ? "*r*" : story.called(i);
            shown.lines = {{middle.x, box.min.y},
                           {middle.x, box.max.y},
                           {box.min.x, middle.y},
                           {box.max.x, middle.y}};
            for (std::uint32_t k = 0; k < orthants<2>; ++k)
                if (node.has(k)) shown.children.push_back(node.child(k));
        }
        tree.nodes.push_back(std::move(shown));
    }
    return tree;
}

/// Turns what the walk met into steps.
class Script {
  public:
    Script(const Story& story, const Ray2& ray) : story_(story), prepared_(ray) {
        const RayPart all = story.visits.front().at.part;
        std::vector<std::uint32_t> order;
        for (std::uint32_t k = 0; k < orthants<2>; ++k) order.push_back(k ^ prepared_.flip);
        waiting_.push_back({0, all.enter, all.leave});
        add({.tells = fmt::format("A ray goes to the right and down. So the children of each cell "
                                  "come in the order {}. The box of all segments leaves it {}.",
                                  fmt::join(order, ", "), interval(all.enter, all.leave)),
             .waiting = waiting_});
        for (const Story::Visit& visit : story.visits) {
            take(visit.at.node);
            if (story_.tree.nodes[visit.at.node].is_leaf())
                leaf(visit);
            else
                inner(visit);
        }
        sum_up();
    }
    std::vector<WalkStep> steps = {};

  private:
    /// What is on top and begins beyond the hit is left alone.
    void take(std::size_t node) {
        while (waiting_.back().node != node) waiting_.pop_back();
        waiting_.pop_back();
    }

    void inner(const Story::Visit& visit) {
        const auto& [node, cube, part] = visit.at;
        const double at_x = prepared_.distance(0, cube.centre.x),
                     at_y = prepared_.distance(1, cube.centre.y);
        const ChildParts<2> of_children = tight_parts(prepared_, cube, part);
        std::vector<std::string> parts;
        std::vector<WalkStep::Visit> met;
        for (std::uint32_t k = 0; k < orthants<2>; ++k) {
            const std::uint32_t child = k ^ prepared_.flip;
            const RayPart its{of_children.enter[k], of_children.leave[k]};
            parts.push_back(described(node, child, its));
            if (story_.tree.nodes[node].has(child) && its.enter <= its.leave)
                met.push_back({story_.tree.nodes[node].child(child), its.enter, its.leave});
        }
        waiting_.insert(waiting_.end(), met.rbegin(), met.rend());
        add({.tells = fmt::format("{}, {}: x = {} at t = {}, y = {} at t = {}. {}.",
                                  node == 0 ? "The root" : "Cell " + story_.called(node),
                                  interval(part.enter, part.leave), written_t(cube.centre.x),
                                  written_t(at_x), written_t(cube.centre.y), written_t(at_y),
                                  fmt::join(parts, "; ")),
             .in_hand = WalkStep::Visit{node, part.enter, part.leave},
             .waiting = {waiting_.begin(), waiting_.end() - 1},
             .next = waiting_.back().node,
             .crossings = {at_x, at_y}});
    }
    std::string described(std::uint32_t node, std::uint32_t child, const RayPart& part) const {
        const OrthtreeNode& parent = story_.tree.nodes[node];
        if (!(part.enter <= part.leave)) return fmt::format("{} is not met", child);
        return fmt::format("{} {}{}", child, interval(part.enter, part.leave),
                           parent.has(child) ? "" : " is empty");
    }

    void leaf(const Story::Visit& visit) {
        const bool hit = visit.nearest < nearest_;
        nearest_ = visit.nearest;
        tested_.insert(tested_.end(), visit.tested.begin(), visit.tested.end());
        add({.tells = fmt::format(
                 "Leaf {}, {}: {} {}.", story_.called(visit.at.node),
                 interval(visit.at.part.enter, visit.at.part.leave), story_.set_of(visit.at.node),
                 hit ? fmt::format("tested, and a hit at t = {}. What waits begins "
                                   "beyond it",
                                   written_t(nearest_))
                     : "tested and missed"),
             .in_hand = WalkStep::Visit{visit.at.node, visit.at.part.enter, visit.at.part.leave},
             .waiting = waiting_,
             .tested = visit.tested});
    }

    void sum_up() {
        std::ranges::sort(tested_);
        const auto [first, last] = std::ranges::unique(tested_);
        tested_.erase(first, last);
        add({.tells = fmt::format("{} of {} nodes were visited, and {} of {} segments tested. What "
                                  "still waited was left alone.",
                                  story_.visits.size(), story_.cells.size(), tested_.size(),
                                  story_.segments.size()),
             .waiting = waiting_,
             .tested = tested_});
    }

    void add(WalkStep step) {
        if (nearest_ < double{infinity}) step.hit = nearest_;
        steps.push_back(std::move(step));
    }

    const Story& story_;
    OrthtreeRay<2> prepared_;
    std::vector<WalkStep::Visit> waiting_;
    std::vector<std::size_t> tested_;
    double nearest_ = infinity;
};

}  // namespace

Svg fig_06_16(const Options&) {
    const Ray2 ray{.origin = {2.75f, 15.25f}, .direction = {1.0f, -1.25f}};
    const Story story(ray);
    return walk_drawing(
        "A ray's walk through a quadtree of the segments A to G, step by step, with what waits",
        drawn(story), ray, Script(story, ray).steps);
}

}  // namespace space::ch06
