/// @file
/// Drawings of simulated builds: which core made which node of a tree, and when.
#pragma once

#include "chapters/ch08_parallel_builds/schedule.hpp"
#include "chapters/ch08_parallel_builds/task_graph.hpp"
#include "common/program/svg.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch08 {

/// Two rows of 8 segments, one the mirror image of the other, of which each gets denser to one
/// side; and one row of 16 that does so twice as far. Trees of leaves of one segment.
TaskGraph mirrored_graph();
TaskGraph lopsided_graph();

/// Who made a node, and when; it alone, or with all below it.
struct MadeBy {
    unsigned core = 0;
    double begin = 0.0, end = 0.0;
    bool in_subtree = false;
};
std::vector<MadeBy> makers(const TaskGraph& graph, const Schedule& schedule);

/// The method with its name, for drawings.
struct DrawnMethod {
    std::string_view name;
    ParallelMethod method;
};

/// Of up to eight cores.
Ink core_ink(unsigned core);

/// Where a drawn tree stands.
struct TreeFrame {
    Point2 corner;
    double slot = 38, level = 50;  ///< from leaf to leaf, and from level to level
};
std::vector<Point2> tree_places(const TaskGraph& graph, const TreeFrame& frame);
/// From the nodes that stand to their children.
void draw_edges(
    Svg& svg, const TaskGraph& graph, const std::vector<Point2>& places,
    const std::function<bool(std::size_t)>& stands = [](std::size_t) { return true; });
/// A circle, for a leaf a square; with what stands in it.
void draw_task(Svg& svg, const TaskNode& node, const Point2& place, Ink ink, bool filled,
               std::string_view text);
/// "core 0", "core 1" ... with their colours, in a line.
void draw_core_names(Svg& svg, const Point2& at, unsigned cores);

/// A step for each moment at which something begins, and for the end: draw(time) draws it. With it
/// goes the sentence at_end or, before, what tells(run) says of those that begin then, core by
/// core.
void draw_moments(Svg& svg, const Schedule& schedule,
                  const std::function<std::string(const CoreRun&)>& tells,
                  const std::string& at_end, const std::function<void(double)>& draw);

/// Where a schedule's bars stand: time to the right, a row for each core.
struct BarFrame {
    Point2 corner;
    double width, row;
    double time;  ///< that the width stands for
};
/// Work as filled bars, waiting for the lock hatched dark, all else empty.
void draw_bars(Svg& svg, const Schedule& schedule, const TaskGraph& graph, const BarFrame& frame);

}  // namespace space::ch08
