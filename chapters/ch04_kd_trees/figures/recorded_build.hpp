/// @file
/// How a k-d tree of named segments came about, and how a ray walked it: the events of builder and
/// walk, kept in order for drawings and for the step-through page.
#pragma once

#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/walk_drawing.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch04 {

/// One turn of the builder's loop. Segments are numbers in Story::segments.
struct Turn {
    std::uint32_t node;
    std::size_t depth;
    Aabb2 cell;
    std::optional<KdSplit> split;
    std::vector<std::uint32_t> set, below, above;  ///< a straddler stands in both halves
};

/// The tree with the turns that made it, in the builder's order.
struct Story {
    std::vector<Segment> segments;
    std::vector<NamedSegment> named;
    KdNodes<2> tree;
    std::vector<Turn> turns;
    KdTreeConfig config = {};           ///< without its planned planes
    std::string_view plane_names = {};  ///< one letter for each inner node's; none: they have none

    const Turn& turn_of(std::uint32_t node) const;
};

/// Builds the tree and watches. Segments are called A, B, C ..
Story watched_build(std::span<const Segment> segments, const KdTreeConfig& config);

/// What a random ray through the tree costs, by the perimeters of its cells; not a number where
/// all of them are 0.
double expected_cost(const Story& story);

/// The planes that Heinonen16 draws: q; on its negative side u and v; on its positive side r, then
/// t below it and s above it.
std::span<const KdSplit> heinonen_planes();
/// The segments A .. G of Heinonen16 with the planes that the thesis draws, and their names there.
Story heinonen_story();
/// "q" for the first inner node of heinonen_story().turns, and so on as in the thesis.
std::string heinonen_plane_name(const Story& story, std::uint32_t node);

/// Where the nodes of the drawn tree stand, by node: see tree_layout.
std::vector<Double2> layout_of(const Story& story);

/// The corners of a box in order.
ConvexCell corners_of(const Aabb2& box);
/// A split within its cell: its two ends.
std::array<Double2, 2> line_in_cell(const Aabb2& cell, const KdSplit& split);
/// "{*A*, *B*}" for drawings.
std::string drawn_set(const Story& story, std::span<const std::uint32_t> set);
/// "{A, B}" for sentences.
std::string plain_set(const Story& story, std::span<const std::uint32_t> set);

/// What a ray met in a node.
struct Visit {
    KdVisit at;
    std::vector<std::uint32_t> tested;  ///< segments of a leaf, also those that were missed
    double nearest;                     ///< the nearest hit after this node; infinity: none
};

/// Looks for the nearest hit, and watches.
std::vector<Visit> watched_walk(const Story& story, const Ray2& ray);

}  // namespace space::ch04
