#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"

#include "chapters/ch08_parallel_builds/record_tasks.hpp"
#include "common/program/tree_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace space::ch08 {
namespace {

/// A node costs a step, and one for each of its segments.
TaskGraph graph_of(const std::vector<Segment>& segments) {
    return counted_tasks<2>(segments, {.node = 1.0, .triangle = 1.0, .bin = 0.0},
                            {.costs = {1.0, 1.0}, .max_leaf_size = 1});
}

/// Of a row whose places shrink towards 0 by a ratio; a segment's length is a tenth of its place.
void add_row(std::vector<Segment>& segments, int count, double ratio, double y) {
    double x = 15.0;
    for (int i = 0; i < count; ++i, x *= ratio)
        segments.push_back({Point2(at(0.9 * x, y)), Point2(at(x, y))});
}

}  // namespace

TaskGraph mirrored_graph() {
    std::vector<Segment> segments;
    add_row(segments, 8, 0.64, 3.0);
    add_row(segments, 8, 0.64, 12.0);
    return graph_of(segments);
}
TaskGraph lopsided_graph() {
    std::vector<Segment> segments;
    add_row(segments, 16, 0.64, 8.0);
    return graph_of(segments);
}

std::vector<MadeBy> makers(const TaskGraph& graph, const Schedule& schedule) {
    std::vector<MadeBy> made(graph.nodes.size());
    for (const CoreRun& run : schedule.runs) {
        if (run.doing == CoreRun::Doing::node) made[run.node] = {run.core, run.begin, run.end};
        if (run.doing != CoreRun::Doing::subtree) continue;
        std::vector<std::uint32_t> waiting{run.node};
        double now = run.begin;
        while (!waiting.empty()) {
            const std::uint32_t index = waiting.back();
            waiting.pop_back();
            const TaskNode& node = graph.nodes[index];
            made[index] = {run.core, now, now + node.cost, true};
            now += node.cost;
            if (node.is_leaf()) continue;
            waiting.push_back(node.first + 1);
            waiting.push_back(node.first);
        }
    }
    return made;
}

Ink core_ink(unsigned core) {
    constexpr std::array inks{Ink::blue,   Ink::vermillion, Ink::green, Ink::purple,
                              Ink::orange, Ink::sky,        Ink::quiet, Ink::ink};
    return inks[core % inks.size()];
}

std::vector<Point2> tree_places(const TaskGraph& graph, const TreeFrame& frame) {
    std::vector<std::vector<std::size_t>> children(graph.nodes.size());
    for (std::size_t i = 0; i < children.size(); ++i)
        if (const TaskNode& node = graph.nodes[i]; !node.is_leaf())
            children[i] = {node.first, node.first + 1};
    std::vector<Point2> places;
    for (const Double2& place : tree_layout(children))
        places.push_back(moved(frame.corner, frame.slot * place.x, frame.level * place.y));
    return places;
}

void draw_edges(Svg& svg, const TaskGraph& graph, const std::vector<Point2>& places,
                const std::function<bool(std::size_t)>& stands) {
    for (std::size_t i = 0; i < places.size(); ++i)
        if (const TaskNode& node = graph.nodes[i]; !node.is_leaf() && stands(i))
            for (const std::uint32_t child : {node.first, node.first + 1})
                svg.line(places[i], places[child], {.stroke = Ink::quiet});
}

void draw_task(Svg& svg, const TaskNode& node, const Point2& place, Ink ink, bool filled,
               std::string_view text) {
    const Style style{
        .stroke = ink, .fill = filled ? ink : Ink::paper, .opacity = filled ? 0.35 : 1.0};
    const auto draw = [&](const Style& with) {
        if (node.is_leaf())
            svg.rect(moved(place, -12, -12), at(24, 24), with);
        else
            svg.circle(place, 14, with);
    };
    if (filled) draw({.stroke = {}, .fill = Ink::paper});  // over the edges
    draw(style);
    svg.text(moved(place, 0, 6), text, {.ink = filled ? Ink::ink : ink, .size = 17, .bold = true});
}

void draw_moments(Svg& svg, const Schedule& schedule,
                  const std::function<std::string(const CoreRun&)>& tells,
                  const std::string& at_end, const std::function<void(double)>& draw) {
    std::map<double, std::string> told;
    for (unsigned core = 0; core < schedule.cores; ++core)
        for (const CoreRun& run : schedule.runs) {
            if (run.core != core) continue;
            std::string& text = told[run.begin];
            if (const std::string more = tells(run); !more.empty())
                text += (text.empty() ? "" : " ") + more;
        }
    told[schedule.makespan] = at_end;
    std::size_t step = 0;
    for (const auto& [time, text] : told) {
        svg.begin_step_alone(step++, told.size(), text);
        draw(time);
        svg.end_group();
    }
}

void draw_core_names(Svg& svg, const Point2& corner, unsigned cores) {
    for (unsigned core = 0; core < cores; ++core) {
        const Point2 place = moved(corner, 110.0 * core, 0);
        svg.rect(place, at(20, 20), {.stroke = {}, .fill = core_ink(core)});
        svg.text(moved(place, 28, 16), fmt::format("core {}", core), {.anchor = Anchor::start});
    }
}

void draw_bars(Svg& svg, const Schedule& schedule, const TaskGraph& graph, const BarFrame& frame) {
    const auto x = [&](double time) { return frame.width * time / frame.time; };
    const double height = frame.row - 4;
    for (unsigned core = 0; core < schedule.cores; ++core)
        svg.line(moved(frame.corner, 0, frame.row * core + frame.row - 2),
                 moved(frame.corner, frame.width, frame.row * core + frame.row - 2),
                 {.stroke = Ink::faint});
    for (const MadeBy& made : makers(graph, schedule)) {
        const Point2 corner = moved(frame.corner, x(made.begin), frame.row * made.core);
        svg.rect(corner, at(x(made.end) - x(made.begin), height),
                 {.stroke = Ink::paper, .fill = core_ink(made.core)});
    }
    for (const CoreRun& run : schedule.runs) {
        const bool waits = run.doing == CoreRun::Doing::lock_wait;
        const bool works = is_work(run.doing) && run.doing != CoreRun::Doing::chunk &&
                           run.doing != CoreRun::Doing::boxing &&
                           run.doing != CoreRun::Doing::joining;
        if (works || run.doing == CoreRun::Doing::join_wait) continue;
        const Point2 corner = moved(frame.corner, x(run.begin), frame.row * run.core);
        svg.rect(corner, at(x(run.end) - x(run.begin), height),
                 {.stroke = waits ? Ink::ink : Ink::paper,
                  .fill = waits                ? Ink::paper
                          : is_work(run.doing) ? core_ink(run.core)
                                               : Ink::ink,
                  .opacity = waits ? 1.0 : 0.6});
    }
}

}  // namespace space::ch08
