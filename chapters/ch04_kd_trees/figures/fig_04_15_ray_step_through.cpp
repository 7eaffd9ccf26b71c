// A ray's walk through the k-d tree of A to G, step by step: what the walk told its observer
// becomes the steps of a drawing.

#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch04 {
namespace {

/// A place in the drawn tree for each node of the story, in the builder's order.
DrawnTree drawn(const Story& story) {
    DrawnTree tree{.size = heinonen_size, .segments = story.named, .nodes = {}};
    const auto number_of = [&](std::uint32_t node) {
        return static_cast<std::size_t>(&story.turn_of(node) - story.turns.data());
    };
    for (const Turn& turn : story.turns) {
        DrawnTree::Node node{.name = "", .cell = corners_of(turn.cell)};
        if (turn.split) {
            const std::uint32_t below = story.tree.nodes[turn.node].below();
            const auto [from, to] = line_in_cell(turn.cell, *turn.split);
            node.name = "*" + heinonen_plane_name(story, turn.node) + "*";
            node.lines = {from, to};
            node.children = {number_of(below), number_of(below + 1)};
        } else {
            node.name = drawn_name(story.named[turn.set.front()].name);
        }
        tree.nodes.push_back(std::move(node));
    }
    return tree;
}

/// Turns what the walk met into steps.
class Script {
  public:
    Script(const Story& story, const Ray2& ray) : story_(story), prepared_(ray) {
        const std::vector<Visit> visits = watched_walk(story, ray);
        const RayPart all = visits.front().at.part;
        add({.tells = fmt::format("A ray starts at the dot and looks for its nearest hit. In the "
                                  "root's cell, the box of all segments, lies its part {}.",
                                  interval(all.enter, all.leave)),
             .waiting = {{0, all.enter, all.leave}}});
        for (const Visit& visit : visits) {
            take(visit);
            if (story_.tree.nodes[visit.at.node].is_leaf())
                leaf(visit);
            else
                inner(visit);
        }
        sum_up(visits.size());
    }
    std::vector<WalkStep> steps = {};

  private:
    /// What waited is in hand now; what lies beyond the hit was left alone on the way.
    void take(const Visit& visit) {
        const std::size_t number = number_of(visit.at.node);
        while (!waiting_.empty() && !in_hand_follows_) {
            const WalkStep::Visit top = waiting_.back();
            waiting_.pop_back();
            if (top.node == number) break;
        }
    }

    void inner(const Visit& visit) {
        const Turn& turn = story_.turn_of(visit.at.node);
        const auto [enter, leave] = visit.at.part;
        const std::uint32_t below = story_.tree.nodes[visit.at.node].below(),
                            far = below + prepared_.far[static_cast<std::size_t>(turn.split->axis)],
                            near = far ^ 1;
        const double t = prepared_.distance(turn.split->axis, turn.split->position);
        WalkStep step{.in_hand = WalkStep::Visit{number_of(visit.at.node), enter, leave},
                      .crossings = {t}};
        const std::string met =
            fmt::format("{} with {}: the plane {} = {} is met at t = {}, ", called(visit.at.node),
                        interval(enter, leave), "xy"[turn.split->axis],
                        svg_number(static_cast<double>(turn.split->position)), written_t(t));
        const bool only_far = t < enter;
        const bool only_near = t > leave;
        step.next = number_of(only_far ? far : near);
        if (only_far) {
            step.tells =
                met + fmt::format("before this part. Only the far half counts, {}.", called(far));
        } else if (only_near) {
            step.tells =
                met + fmt::format("after this part. Only the near half counts, {}.", called(near));
        } else {
            step.tells =
                met + fmt::format(
                          "within. First the near half, {}, with {}; the far one, {}, "
                          "waits with {}.",
                          called(near), interval(enter, t), called(far), interval(t, leave));
            waiting_.push_back({number_of(far), t, leave});
        }
        in_hand_follows_ = true;
        step.waiting = waiting_;
        add(std::move(step));
    }

    void leaf(const Visit& visit) {
        const bool hit = visit.nearest < nearest_;
        nearest_ = visit.nearest;
        WalkStep step{.in_hand = WalkStep::Visit{number_of(visit.at.node), visit.at.part.enter,
                                                 visit.at.part.leave}};
        step.tested.assign(visit.tested.begin(), visit.tested.end());
        tested_.insert(tested_.end(), step.tested.begin(), step.tested.end());
        step.tells = fmt::format(
            "The leaf {} with {}: {} is tested and {}.", called(visit.at.node),
            interval(visit.at.part.enter, visit.at.part.leave), called(visit.at.node),
            hit ? fmt::format("hit, at t = {}. {}", written_t(nearest_),
                              nearest_ <= visit.at.part.leave
                                  ? "What waits begins beyond that: nothing of it counts"
                                  : "That is beyond the cell: what waits may be nearer")
                : "missed");
        in_hand_follows_ = false;
        step.waiting = waiting_;
        add(std::move(step));
    }

    void sum_up(std::size_t visited) {
        std::vector<std::string> names;
        for (const std::size_t i : tested_) names.push_back(story_.named[i].name);
        add({.tells = fmt::format("{} of {} nodes were visited, and {} of {} segments tested: {}. "
                                  "What still waited was left alone.",
                                  visited, story_.turns.size(), tested_.size(),
                                  story_.segments.size(), fmt::join(names, ", ")),
             .waiting = waiting_,
             .tested = tested_});
    }

    void add(WalkStep step) {
        if (nearest_ < double{infinity}) step.hit = nearest_;
        steps.push_back(std::move(step));
    }
    std::size_t number_of(std::uint32_t node) const {
        return static_cast<std::size_t>(&story_.turn_of(node) - story_.turns.data());
    }
    std::string called(std::uint32_t node) const {
        const Turn& turn = story_.turn_of(node);
        return turn.split ? heinonen_plane_name(story_, node) : story_.named[turn.set.front()].name;
    }

    const Story& story_;
    KdRay<2> prepared_;
    std::vector<WalkStep::Visit> waiting_;
    bool in_hand_follows_ = true;  ///< the next visit comes from this one, not from what waits
    std::vector<std::size_t> tested_;
    double nearest_ = infinity;
};

}  // namespace

Svg fig_04_15(const Options&) {
    const Story story = heinonen_story();
    const Ray2 ray{.origin = {0.5f, 14.125f}, .direction = {1.0f, -0.5f}};
    return walk_drawing(
        "A ray's walk through the k-d tree of the segments A to G, step by step, with what waits",
        drawn(story), ray, Script(story, ray).steps);
}

}  // namespace space::ch04
