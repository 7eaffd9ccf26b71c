#include "chapters/ch03_bsp_trees/figures/drawn_walk.hpp"

#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"
#include "chapters/ch03_bsp_trees/figures/recorded_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace space::ch03 {
namespace {

/// Nodes as they are numbered in the tree, and after them the empty cells.
DrawnTree drawn(const Story& story) {
    DrawnTree tree{.size = heinonen_size, .segments = {}, .nodes = {}};
    for (const std::size_t piece : story.fragment_pieces)
        tree.segments.push_back(
            {story.pieces[piece].name, story.pieces[piece].from, story.pieces[piece].to});
    const auto children = children_of(story);
    for (std::size_t i = 0; i < story.turns.size(); ++i) {
        const auto [from, to] = line_in_cell(story, i);
        tree.nodes.push_back({.name = written(story.splitter(i)),
                              .cell = story.turns[i].cell,
                              .lines = {from, to},
                              .children = children[i]});
    }
    for (const EmptyCell& cell : story.cells) tree.nodes.push_back({.name = "", .cell = cell.cell});
    return tree;
}

/// Turns the walk's events into steps.
class WalkScript {
  public:
    WalkScript(const Story& story, const BasicRay<2>& ray)
        : story_(story), ray_(ray), children_(children_of(story)) {
        if (story.turns.empty()) {
            add({.tells = "No segment has an extent: there is no tree, and nothing to hit."});
            return;
        }
        waiting_.push_back({0, ray.tmin, ray.tmax});
        add({.tells = fmt::format(
                 "A ray starts at the dot and looks for its nearest hit. All of it, {}, lies in "
                 "the cell of the root {}.",
                 interval(ray.tmin, ray.tmax), name(0))});
        waiting_.clear();
        for (const WalkEvent& event : watched_walk(story.tree, ray))
            std::visit([&](const auto& told) { observe(told); }, event);
        sum_up();
    }
    std::vector<WalkStep> steps = {};

  private:
    void observe(const BspWalk::Visited& event) {
        const PlaneCrossing& crossing = event.crossing;
        const double t = 0.5 * (crossing.earliest + crossing.latest);
        const bool anywhere = !(t > -double{infinity});  // also where t is not a number
        const std::size_t near = child(event.node, crossing.starts_in_front),
                          far = child(event.node, !crossing.starts_in_front);
        visited_.insert(event.node);
        const std::string met =
            fmt::format("{} with {}: the ray comes from {} its line and ", name(event.node),
                        interval(event.enter, event.leave),
                        crossing.starts_in_front ? "in front of" : "behind") +
            (anywhere                ? "runs along it, so far as can be told, "
             : t == double{infinity} ? "never meets it, "
                                     : fmt::format("meets it at t = {}, ", written_t(t)));
        WalkStep step{.in_hand = WalkStep::Visit{event.node, event.enter, event.leave},
                      .crossings = {t}};
        if (crossing.latest < event.enter) {
            step.tells = met + fmt::format("before the interval. So only the far child counts, {}.",
                                           called(far));
            step.next = far;
        } else if (crossing.earliest > event.leave) {
            step.tells = met + fmt::format("after the interval. So only the near child counts, {}.",
                                           called(near));
            step.next = near;
        } else {
            // All of the interval on both sides where t is not a number.
            const double from = std::max(event.enter, t), to = std::min(event.leave, t);
            step.tells = met + fmt::format(
                                   "within the interval. First the near child, {}, with {}. The "
                                   "segments in the line and the far child, {}, wait with {}.",
                                   called(near), interval(event.enter, to), called(far),
                                   interval(from, event.leave));
            step.next = near;
            waiting_.push_back({far, from, event.leave});
        }
        add(step);
    }

    void observe(const BspWalk::Crossed& event) {
        const std::size_t far = waiting_.back().node;
        waiting_.pop_back();
        WalkStep step{.in_hand = WalkStep::Visit{event.node, event.enter, event.leave},
                      .next = far,
                      .crossings = {event.enter}};
        std::string names;
        for (const std::size_t piece : own(event.node)) {
            step.tested.push_back(piece);
            names += (names.empty() ? "" : ", ") + plain_name(piece_name(piece));
        }
        tested_.insert(tested_.end(), step.tested.begin(), step.tested.end());
        const double hit = hit_in(story_.tree, event.node, ray_);
        hit_ = std::min(hit_, hit);
        step.tells = fmt::format(
            "Nothing is left before the line of {}. {} {} tested: {} Then the far child, {}, "
            "with {}.",
            name(event.node), names, step.tested.size() == 1 ? "is" : "are",
            hit == double{infinity}
                ? "missed."
                : fmt::format("hit, at t = {}. Nothing beyond that counts any more.",
                              written_t(hit)),
            called(far), interval(event.enter, event.leave));
        add(step);
    }

    void observe(const BspWalk::Dropped& event) {
        dropped_.push_back(waiting_.back());
        add({.tells = fmt::format("The line of {} and what is beyond it wait with {}: farther than "
                                  "the hit at t = {}. They are left alone.",
                                  name(event.node), interval(event.enter, event.leave),
                                  written_t(hit_))});
        waiting_.pop_back();
    }

    void sum_up() {
        waiting_ = dropped_;
        add({.tells = fmt::format(
                 "Nothing waits any more. {} of {} nodes were visited, and {} of the {} segments "
                 "and pieces tested.",
                 visited_.size(), story_.turns.size(), tested_.size(),
                 story_.fragment_pieces.size()),
             .tested = tested_});
    }

    void add(WalkStep step) {
        step.waiting = waiting_;
        if (hit_ < double{infinity}) step.hit = hit_;
        steps.push_back(std::move(step));
    }

    std::size_t child(std::uint32_t node, bool in_front) const {
        return children_[node][in_front ? 1 : 0];
    }
    std::string piece_name(std::size_t fragment) const {
        return story_.pieces[story_.fragment_pieces[fragment]].name;
    }
    std::vector<std::size_t> own(std::uint32_t node) const {
        std::vector<std::size_t> fragments;
        for (std::uint32_t i = 0; i < story_.tree.nodes[node].count; ++i)
            fragments.push_back(story_.tree.nodes[node].first + i);
        return fragments;
    }
    std::string name(std::size_t node) const { return plain_name(story_.splitter(node).name); }
    std::string called(std::size_t child) const {
        return child < story_.turns.size() ? name(child) : "an empty cell";
    }

    const Story& story_;
    const BasicRay<2>& ray_;
    std::vector<std::vector<std::size_t>> children_;
    std::vector<WalkStep::Visit> waiting_, dropped_;
    std::set<std::size_t> visited_;
    std::vector<std::size_t> tested_;
    double hit_ = infinity;
};

}  // namespace

std::vector<WalkStep> told_walk(const Story& story, const BasicRay<2>& ray) {
    return WalkScript(story, ray).steps;
}

Svg drawn_walk(std::string title, const Story& story, const BasicRay<2>& ray,
               const std::vector<WalkStep>& steps) {
    return walk_drawing(std::move(title), drawn(story), ray, steps);
}

}  // namespace space::ch03
