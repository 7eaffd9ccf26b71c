#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"
#include "chapters/ch03_bsp_trees/figures/recorded_walk.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

namespace space::ch03 {
namespace {

/// Whether the way from `from` to `to` passes through a convex cell.
bool passes(const ConvexCell& cell, const Double2& from, const Double2& to) {
    double enter = 0.0, leave = 1.0;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const Double2 &a = cell[i], side = cell[(i + 1) % cell.size()] - a;
        const auto left_of = [&](const Double2& p) {
            return side.x * (p.y - a.y) - side.y * (p.x - a.x);
        };
        const double start = left_of(from), end = left_of(to);
        if (start < 0.0 && end < 0.0) return false;
        if (start < 0.0) enter = std::max(enter, start / (start - end));
        if (end < 0.0) leave = std::min(leave, start / (start - end));
    }
    return enter < leave;
}

constexpr double plane_width = 26.0, plane_height = 13.0;

/// What the ray did on its way from `start` to its hit.
struct Walk {
    Double2 start, end;
    std::vector<std::size_t> visited = {}, crossed = {};  ///< nodes
};

bool is_in(const std::vector<std::size_t>& list, std::size_t i) {
    return std::ranges::find(list, i) != list.end();
}

Walk walk_of(const BasicRay<2>& ray, const BspTree<2>& tree) {
    Walk walk{.start = Double2(ray.origin), .end = {}};
    double nearest = infinity;
    for (const WalkEvent& event : watched_walk(tree, ray)) {
        if (const auto* visited = std::get_if<BspWalk::Visited>(&event))
            walk.visited.push_back(visited->node);
        if (const auto* crossed = std::get_if<BspWalk::Crossed>(&event)) {
            walk.crossed.push_back(crossed->node);
            nearest = std::min(nearest, hit_in(tree, crossed->node, ray));
        }
    }
    walk.end = walk.start + nearest * Double2(ray.direction);
    return walk;
}

void draw_plane(Svg& svg, const Story& story, const Walk& walk) {
    const PlaneView view{.corner = {8, 16}, .scale = 24, .size = plane_height};
    for (const EmptyCell& cell : story.cells)
        if (passes(cell.cell, walk.start, walk.end))
            svg.polygon(view(cell.cell), {.stroke = {}, .fill = Ink::sky, .opacity = 0.3});
    for (const bool second : {false, true})
        for (std::size_t i = 0; i < story.turns.size(); ++i) {
            if (is_in(walk.crossed, i) != second) continue;
            const auto [from, to] = line_in_cell(story, i);
            svg.line(view(from), view(to), {.stroke = second ? Ink::blue : Ink::faint});
        }
    for (std::size_t node = 0; node < story.turns.size(); ++node)
        for (const std::size_t own : story.turns[node].own) {
            const Piece& piece = story.pieces[own];
            draw_segment(svg, view, piece.from, piece.to,
                         {.stroke = {}, .fill = is_in(walk.crossed, node) ? Ink::green : Ink::ink});
        }
    svg.rect(view({0, plane_height}), at(24 * plane_width, 24 * plane_height),
             {.stroke = Ink::quiet});
    svg.line(view(walk.start), view(walk.end), {.stroke = Ink::vermillion, .arrow = true}, "ray");
    svg.circle(view(walk.start), 5, {.stroke = {}, .fill = Ink::vermillion});
    svg.circle(view(walk.end), 6, {.stroke = Ink::vermillion});
}

constexpr double tree_row = 26;

void draw_tree(Svg& svg, const Story& story, const TreeLayout& layout, const Walk& walk) {
    const double slots = static_cast<double>(story.cells.size()), slot = 620.0 / slots;
    const auto place = [&](const Double2& p) { return at(10 + slot * p.x, 356 + tree_row * p.y); };
    for (std::size_t i = 0; i < story.turns.size(); ++i)
        if (story.turns[i].parent != BspTree<2>::none)
            svg.line(place(layout.nodes[story.turns[i].parent]), place(layout.nodes[i]),
                     {.stroke = is_in(walk.visited, i) ? Ink::ink : Ink::faint});
    for (std::size_t i = 0; i < story.turns.size(); ++i) {
        const bool both = is_in(walk.crossed, i);
        svg.circle(place(layout.nodes[i]), 6.5,
                   {.stroke = both                     ? Ink::blue
                              : is_in(walk.visited, i) ? Ink::ink
                                                       : Ink::faint,
                    .fill = both ? Ink::blue : Ink::paper});
    }
}

void draw_legend(Svg& svg, double bottom, const Walk& walk, std::size_t nodes) {
    svg.circle(at(18, bottom - 6), 6.5, {.stroke = Ink::blue, .fill = Ink::blue});
    svg.text(at(34, bottom), fmt::format("{} crossed: both children", walk.crossed.size()),
             {.anchor = Anchor::start, .size = 17});
    svg.circle(at(278, bottom - 6), 6.5, {.stroke = Ink::ink, .fill = Ink::paper});
    svg.text(at(294, bottom),
             fmt::format("{} one child", walk.visited.size() - walk.crossed.size()),
             {.anchor = Anchor::start, .size = 17});
    svg.circle(at(438, bottom - 6), 6.5, {.stroke = Ink::faint, .fill = Ink::paper});
    svg.text(at(454, bottom), fmt::format("{} not visited", nodes - walk.visited.size()),
             {.anchor = Anchor::start, .size = 17});
}

}  // namespace

Svg fig_03_08(const Options&) {
    const Story story =
        watched_build(scattered_segments(),
                      {.splitter = BspConfig::SplitterChoice::weighted, .split_weight = 3.0},
                      {{0, 0}, {plane_width, 0}, {plane_width, plane_height}, {0, plane_height}});
    const BasicRay<2> ray{.origin = {0.7f, 11.5f}, .direction = {1.0f, -0.4f}};
    const Walk walk = walk_of(ray, story.tree);
    const TreeLayout layout = layout_of(story);
    Svg svg(
        "A ray walks a BSP tree front to back: both children only where it crosses a node's "
        "line, and no further than its hit",
        640, 24 + 312 + 60 + tree_row * static_cast<double>(layout.levels - 1));
    draw_plane(svg, story, walk);
    draw_tree(svg, story, layout, walk);
    draw_legend(svg, 356 + tree_row * static_cast<double>(layout.levels - 1) + 24, walk,
                story.turns.size());
    return svg;
}

}  // namespace space::ch03
