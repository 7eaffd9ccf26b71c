/// @file
/// How a tree of boxes over named segments came about: the builder's events, kept in order for
/// drawings and for the step-through page.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "common/observer.hpp"
#include "common/program/plane_view.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace space::ch07 {

/// One turn of the builder's loop. Segments are numbers in Story::segments.
struct Turn {
    std::uint32_t node;
    Aabb2 box;
    std::vector<BvhReference<2>> set;
    std::size_t first = 0;  ///< how many of the set go to the first child; none of a leaf's
};

/// The tree with the turns that made it, in the builder's order.
struct Story {
    std::vector<Segment> segments;
    std::vector<NamedSegment> named;
    BvhNodes<2> tree = {};
    std::vector<Turn> turns = {};

    std::size_t turn_of(std::uint32_t node) const;
};

/// Segments are called A, B, C ..
Story story_of(std::span<const Segment> segments);

/// Writes a top-down builder's events down.
struct BuildWatcher : NoObserver {
    using NoObserver::observe;
    std::vector<Turn>& turns;

    explicit BuildWatcher(std::vector<Turn>& to) : turns(to) {}
    void observe(const BvhChosen<2>& event) {
        turns.push_back({event.task.node,
                         event.task.box,
                         {event.task.range.begin(), event.task.range.end()},
                         event.cut ? event.cut->count : 0});
    }
};

/// Builds the tree and watches.
template <class Builder>
Story watched_build(std::span<const Segment> segments, const typename Builder::Config& config) {
    Story story = story_of(segments);
    BuildWatcher watcher(story.turns);
    story.tree = Builder::template build<2>(story.segments, config, watcher);
    return story;
}

/// The corners of a box in order.
ConvexCell corners_of(const Aabb2& box);
/// Its four sides: two ends of each.
std::vector<Double2> sides_of(const Aabb2& box);
/// A box on the paper, made larger by some of the paper's units on each side.
void draw_box(Svg& svg, const PlaneView& view, const Aabb2& box, double larger, const Style& style);

/// "{A, B}" for sentences.
std::string plain_set(const Story& story, std::span<const BvhReference<2>> set);
/// Where the nodes of the drawn tree stand, by node: see tree_layout.
std::vector<Double2> layout_of(const BvhNodes<2>& tree);
/// The nodes in depth-first order, by which drawings number the inner ones, from 1 on.
std::vector<std::uint32_t> inner_numbers(const BvhNodes<2>& tree);
/// A leaf's segment, or an inner node's number.
std::string plain_node_name(const Story& story, std::uint32_t node);
std::string drawn_node_name(const Story& story, std::uint32_t node);

}  // namespace space::ch07
