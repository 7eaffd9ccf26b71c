#include "chapters/ch07_bounding_volume_hierarchies/figures/drawn_walk.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/bvh_walk.hpp"
#include "common/program/walk_drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace space::ch07 {
namespace {

/// What a ray met in a node.
struct Visit {
    std::uint32_t node;
    double nearest;  ///< the nearest hit after this node; infinity: none
};

std::vector<Visit> watched_walk(const Story& story, const Ray2& ray) {
    struct Watcher {
        std::vector<Visit> visits = {};
        double nearest = infinity;
        void observe(const BvhVisit& event) { visits.push_back({event.node, nearest}); }
    } watcher;
    NoCounts none;
    walk_bvh(
        story.tree, ray, none,
        [&](const BvhNode<2>& leaf) {
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
                watcher.nearest = std::min(
                    watcher.nearest, distance_along(ray, story.segments[story.tree.references[i]]));
            return watcher.visits.back().nearest = watcher.nearest;
        },
        watcher);
    return watcher.visits;
}

/// A place in the drawn tree for each node, in depth-first order.
DrawnTree drawn(const Story& story, std::optional<unsigned> level) {
    DrawnTree tree{.size = heinonen_size, .segments = story.named, .nodes = {}};
    for (const Turn& turn : story.turns) {
        DrawnTree::Node node{.name = drawn_node_name(story, turn.node),
                             .cell = corners_of(turn.box),
                             .lines = sides_of(turn.box)};
        if (turn.first > 0) {
            const std::uint32_t first = story.tree.nodes[turn.node].first;
            node.children = {story.turn_of(first), story.turn_of(first + 1)};
        }
        tree.nodes.push_back(std::move(node));
    }
    if (level)
        story.tree.for_each_node([&](std::uint32_t index, unsigned depth) {
            tree.nodes[story.turn_of(index)].ink =
                depth == *level ? std::optional(Ink::purple) : std::nullopt;
        });
    return tree;
}

/// Turns what the walk met into steps. What came next, and what later, is as the walk has it:
/// its margins decide where two boxes begin together, or where a ray runs along a side.
class Script {
  public:
    Script(const Story& story, const Ray2& ray)
        : story_(story), prepared_(ray, BoxMargins::none), visits_(watched_walk(story, ray)) {
        if (visits_.empty()) {
            add({.tells = "The ray misses the root's box, and so all that is in it."});
            return;
        }
        waiting_.push_back(visit_of(0));
        add({.tells = fmt::format("A ray starts at the dot and looks for its nearest hit. It is in "
                                  "the root's box for {}.",
                                  written(waiting_.back())),
             .waiting = waiting_});
        for (std::size_t k = 0; k < visits_.size(); ++k) {
            take(visits_[k].node);
            if (story_.tree.nodes[visits_[k].node].is_leaf())
                leaf(visits_[k]);
            else
                inner(k);
        }
        sum_up();
    }
    std::vector<WalkStep> steps = {};

  private:
    /// What is on top and begins beyond the hit is left alone.
    void take(std::uint32_t node) {
        const std::size_t number = story_.turn_of(node);
        while (waiting_.back().node != number) {
            left_alone_.push_back(waiting_.back());
            waiting_.pop_back();
        }
        waiting_.pop_back();
    }

    bool is_visited_after(std::size_t k, std::uint32_t node) const {
        return std::any_of(visits_.begin() + static_cast<std::ptrdiff_t>(k) + 1, visits_.end(),
                           [&](const Visit& visit) { return visit.node == node; });
    }

    void inner(std::size_t k) {
        const std::uint32_t node = visits_[k].node, first = story_.tree.nodes[node].first;
        const std::uint32_t next = k + 1 < visits_.size() ? visits_[k + 1].node : 0;
        const bool goes_on = next == first || next == first + 1;
        std::vector<WalkStep::Visit> met;
        std::vector<std::string> parts;
        for (const std::uint32_t child : {first, first + 1}) {
            const WalkStep::Visit part = visit_of(child);
            const bool touches = part.enter <= part.leave, beyond = part.enter > nearest_;
            const bool is_met = is_visited_after(k, child) || (goes_on && touches && !beyond);
            if (is_met) met.push_back(part);
            parts.push_back(plain_node_name(story_, child) + (is_met ? " for " + written(part)
                                                              : touches && beyond
                                                                  ? " begins beyond the hit"
                                                                  : " is not met"));
        }
        if (met.size() == 2 && next == first) std::swap(met[0], met[1]);
        waiting_.insert(waiting_.end(), met.begin(), met.end());
        WalkStep step{.tells = fmt::format("Node {}, {}: {}.", plain_node_name(story_, node),
                                           written(visit_of(node)), fmt::join(parts, ", ")),
                      .in_hand = visit_of(node),
                      .waiting = waiting_};
        if (met.size() == 2) step.tells += " The nearer box comes first, the other waits.";
        if (!met.empty()) {
            step.next = met.back().node;
            step.waiting.pop_back();
        }
        add(std::move(step));
    }

    void leaf(const Visit& visit) {
        const bool hit = visit.nearest < nearest_;
        nearest_ = visit.nearest;
        WalkStep step{.in_hand = visit_of(visit.node), .waiting = waiting_};
        for (const std::uint32_t i : story_.tree.own(visit.node)) step.tested.push_back(i);
        tested_.insert(tested_.end(), step.tested.begin(), step.tested.end());
        step.tells = fmt::format(
            "The leaf {}, {}: {}.", plain_node_name(story_, visit.node), written(*step.in_hand),
            hit ? fmt::format("a hit, at t = {}", written_t(nearest_)) : "tested and missed");
        if (hit && !waiting_.empty())
            step.tells += waiting_.back().enter <= nearest_
                              ? " What waits begins before that: it may have a nearer hit."
                              : " What waits begins beyond that.";
        add(std::move(step));
    }

    void sum_up() {
        left_alone_.insert(left_alone_.end(), waiting_.begin(), waiting_.end());
        add({.tells = fmt::format("{} of {} nodes were visited, and {} of {} segments tested.{}",
                                  visits_.size(), story_.tree.size(), tested_.size(),
                                  story_.segments.size(),
                                  left_alone_.empty() ? "" : " What still waited was left alone."),
             .waiting = left_alone_,
             .tested = tested_});
    }

    void add(WalkStep step) {
        if (nearest_ < double{infinity}) step.hit = nearest_;
        steps.push_back(std::move(step));
    }
    WalkStep::Visit visit_of(std::uint32_t node) const {
        const auto [enter, leave] = prepared_.span_in(story_.tree.nodes[node].box, infinity);
        return {story_.turn_of(node), double{enter}, double{leave}};
    }
    static std::string written(const WalkStep::Visit& part) {
        return interval(part.enter, part.leave);
    }

    const Story& story_;
    BvhRay<2> prepared_;  ///< without margins: what is written has two places
    std::vector<Visit> visits_;
    std::vector<WalkStep::Visit> waiting_, left_alone_;
    std::vector<std::size_t> tested_;
    double nearest_ = infinity;
};

}  // namespace

Svg drawn_walk(std::string title, const Story& story, const Ray2& ray,
               std::optional<unsigned> level) {
    return walk_drawing(std::move(title), drawn(story, level), ray, Script(story, ray).steps);
}

}  // namespace space::ch07
