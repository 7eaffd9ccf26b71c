#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace space::ch04 {
namespace {

constexpr double plane_height = 13.0, plane_scale = 24, row = 26;
constexpr SahCosts costs{.intersection = 2.0, .empty_bonus = 0.2};  // for many small cells

/// What the ray did on its way from `start` to its hit.
struct Walk {
    Double2 start, end;
    std::set<std::uint32_t> visited = {}, both = {};  ///< nodes; those of which both halves count
    std::set<std::uint32_t> tested = {};              ///< segments

    Walk(const Story& story, const Ray2& ray) : start(ray.origin), end(ray.origin) {
        for (const Visit& visit : watched_walk(story, ray)) {
            visited.insert(visit.at.node);
            tested.insert(visit.tested.begin(), visit.tested.end());
            end = start + visit.nearest * Double2(ray.direction);
            const KdNode node = story.tree.nodes[visit.at.node];
            if (node.is_leaf()) continue;
            const double t = KdRay<2>(ray).distance(node.axis(), node.position());
            if (t >= visit.at.part.enter && t <= visit.at.part.leave) both.insert(visit.at.node);
        }
    }
};

void draw_plane(Svg& svg, const Story& story, const Walk& walk) {
    const PlaneView view{.corner = {8, -12}, .scale = plane_scale, .size = plane_height};
    for (const Turn& turn : story.turns)
        if (!turn.split && walk.visited.contains(turn.node))
            svg.polygon(view(corners_of(turn.cell)),
                        {.stroke = {}, .fill = Ink::sky, .opacity = 0.3});
    for (const bool second : {false, true})
        for (const Turn& turn : story.turns) {
            if (!turn.split || walk.both.contains(turn.node) != second) continue;
            const auto [from, to] = line_in_cell(turn.cell, *turn.split);
            svg.line(view(from), view(to), {.stroke = second ? Ink::blue : Ink::faint});
        }
    svg.polygon(view(corners_of(story.tree.box)), {.stroke = Ink::quiet});
    for (std::uint32_t i = 0; i < story.segments.size(); ++i)
        draw_segment(svg, view, Double2(story.segments[i].a), Double2(story.segments[i].b),
                     {.stroke = {}, .fill = walk.tested.contains(i) ? Ink::green : Ink::ink});
    svg.line(view(walk.start), view(walk.end), {.stroke = Ink::vermillion, .arrow = true}, "ray");
    svg.circle(view(walk.start), 5, {.stroke = {}, .fill = Ink::vermillion});
    svg.circle(view(walk.end), 6, {.stroke = Ink::vermillion});
}

void draw_tree(Svg& svg, const Story& story, const Walk& walk) {
    const std::vector<Double2> layout = layout_of(story);
    double slots = 0.0;
    for (const Turn& turn : story.turns) slots = std::max(slots, layout[turn.node].x + 0.5);
    const auto place = [&](std::uint32_t node) {
        return at(10 + 620.0 / slots * layout[node].x, 316 + row * layout[node].y);
    };
    const auto ink_of = [&](std::uint32_t node) {
        return walk.both.contains(node)      ? Ink::blue
               : walk.visited.contains(node) ? Ink::ink
                                             : Ink::faint;
    };
    for (const Turn& turn : story.turns) {
        if (!turn.split) continue;
        const std::uint32_t below = story.tree.nodes[turn.node].below();
        for (const std::uint32_t child : {below, below + 1})
            svg.line(place(turn.node), place(child),
                     {.stroke = walk.visited.contains(child) ? Ink::ink : Ink::faint});
    }
    for (const Turn& turn : story.turns) {
        const bool both = walk.both.contains(turn.node);
        if (turn.split) {
            svg.circle(place(turn.node), 6,
                       {.stroke = ink_of(turn.node), .fill = both ? Ink::blue : Ink::paper});
        } else {
            const bool visited = walk.visited.contains(turn.node);
            svg.rect(moved(place(turn.node), -5, -5), at(10, 10),
                     {.stroke = ink_of(turn.node), .fill = visited ? Ink::sky : Ink::paper});
        }
    }
}

void draw_legend(Svg& svg, const Story& story, const Walk& walk, double bottom) {
    std::size_t leaves = 0, passed = 0;
    for (const Turn& turn : story.turns) {
        leaves += !turn.split;
        passed += !turn.split && walk.visited.contains(turn.node);
    }
    svg.circle(at(18, bottom - 6), 6, {.stroke = Ink::blue, .fill = Ink::blue});
    svg.text(at(32, bottom),
             fmt::format("{} of {} inner nodes: both halves", walk.both.size(),
                         story.turns.size() - leaves),
             {.anchor = Anchor::start, .size = 17});
    svg.rect(at(352, bottom - 11), at(10, 10), {.stroke = Ink::ink, .fill = Ink::sky});
    svg.text(at(370, bottom),
             fmt::format("{} of {} leaves, {} of {} tested", passed, leaves, walk.tested.size(),
                         story.segments.size()),
             {.anchor = Anchor::start, .size = 17});
}

}  // namespace

Svg fig_04_09(const Options&) {
    const Story story = watched_build(scattered_segments(), {.costs = costs});
    const Walk walk(story, Ray2{.origin = {0.7f, 11.5f}, .direction = {1.0f, -0.4f}});
    const double bottom = 316 + row * static_cast<double>(story.tree.depth);
    Svg svg(
        "A ray walks a k-d tree front to back: both halves only where it crosses a plane within "
        "the cell, and no further than its hit",
        640, bottom + 44);
    draw_plane(svg, story, walk);
    draw_tree(svg, story, walk);
    draw_legend(svg, story, walk, bottom + 32);
    return svg;
}

}  // namespace space::ch04
