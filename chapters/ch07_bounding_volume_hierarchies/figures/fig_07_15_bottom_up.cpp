// A tree from the leaves up, round by round: who is whose nearest, and what becomes of it.

#include "chapters/ch07_bounding_volume_hierarchies/bottom_up_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch07 {
namespace {

struct Merge {
    Aabb2 one, other, both;
    unsigned round;
};
struct Watcher : NoObserver {
    using NoObserver::observe;
    std::vector<Merge> merges = {};
    void observe(const BottomUpBuilder::Merged<2>& event) {
        merges.push_back({event.one.box, event.other.box, event.box, event.round});
    }
};

/// The boxes that stand alone after some rounds, and those of them that the last round has made.
struct Standing {
    std::vector<Aabb2> kept = {};
    std::vector<Merge> made = {};

    std::size_t size() const { return kept.size() + made.size(); }
};

std::vector<Standing> rounds_of(const std::vector<BvhReference<2>>& references,
                                const std::vector<Merge>& merges) {
    Standing now;
    for (const BvhReference<2>& reference : references) now.kept.push_back(reference.box);
    std::vector<Standing> all{now};
    for (const Merge& merge : merges) {
        if (merge.round + 1 == all.size()) {  // the first of a round
            for (const Merge& made : now.made) now.kept.push_back(made.both);
            now.made.clear();
            all.emplace_back();
        }
        for (const Aabb2& part : {merge.one, merge.other})
            now.kept.erase(std::ranges::find(now.kept, part));
        now.made.push_back(merge);
        all.back() = now;
    }
    return all;
}

std::string told(const std::vector<Standing>& rounds, std::size_t round) {
    const Standing& now = rounds[round];
    if (round == 0)
        return fmt::format("{} segments, each a tree of its own, in its box.", now.size());
    if (now.size() == 1)
        return fmt::format("Round {}: the last two become the root's children. {} merges in all.",
                           round, rounds.front().size() - 1);
    return fmt::format(
        "Round {}: {} {} each other's nearest, and become one box each. {} are left.", round,
        now.made.size(), now.made.size() == 1 ? "pair is" : "pairs are", now.size());
}

}  // namespace

Svg fig_07_15(const Options&) {
    const std::vector<Segment> segments = scattered_segments();
    const PlaneView view{.corner = {13, 10}, .scale = 25, .size = 13};
    Watcher watcher;
    BottomUpBuilder::build<2>(segments, {}, watcher);
    const std::vector<Standing> rounds = rounds_of(boxed<2>(segments), watcher.merges);
    Svg svg("Segments that a builder joins from below, round by round", 676, 346);
    for (std::size_t k = 0; k < rounds.size(); ++k) {
        svg.begin_step_alone(k, rounds.size(), told(rounds, k));
        for (const Aabb2& box : rounds[k].kept) draw_box(svg, view, box, 3, {.stroke = Ink::blue});
        for (const Merge& merge : rounds[k].made) {
            for (const Aabb2& part : {merge.one, merge.other})
                draw_box(svg, view, part, 2, {.stroke = Ink::sky});
            draw_box(svg, view, merge.both, 4,
                     {.stroke = Ink::green, .fill = Ink::green, .opacity = 0.18});
        }
        svg.end_group();
    }
    for (const Segment& segment : segments)
        draw_segment(svg, view, Double2(segment.a), Double2(segment.b),
                     {.stroke = {}, .fill = Ink::ink});
    return svg;
}

}  // namespace space::ch07
