#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace space::ch03 {

Svg fig_03_06(const Options&) {
    constexpr int sides = 24;
    std::vector<Segment> body;  // clockwise, so that fronts look outwards
    const auto corner = [](int i) {
        const double angle = -2.0 * std::numbers::pi * (i + 0.35) / sides;
        return Point2(at(7.0 + 4.6 * std::cos(angle), 7.0 + 4.6 * std::sin(angle)));
    };
    for (int i = 0; i < sides; ++i) body.push_back({corner(i), corner(i + 1)});
    constexpr double size = 14.0, slot = 12.0;
    const ConvexCell frame{{0, 0}, {size, 0}, {size, size}, {0, size}};

    Svg svg("A convex polygon's own lines make a chain; with free lines the tree is shallow", 640,
            604);
    const auto panel = [&](double left, const BspConfig& config, const char* name,
                           std::string_view id) {
        const Story story = watched_build(body, config, frame);
        const PlaneView view{.corner = {left, 34}, .scale = 304 / size, .size = size};
        svg.text(at(left + 152, 22), name, {.bold = true});
        svg.begin_group(id);
        for (std::size_t i = 0; i < story.turns.size(); ++i) {
            const bool is_free = !story.turns[i].splitter;
            const auto [from, to] = line_in_cell(story, i);
            svg.line(view(from), view(to), {.stroke = is_free ? Ink::vermillion : Ink::blue});
        }
        for (const std::size_t i : story.fragment_pieces)
            draw_segment(svg, view, story.pieces[i].from, story.pieces[i].to,
                         {.stroke = {}, .fill = Ink::ink});
        svg.rect(view({0, size}), at(304, 304), {.stroke = Ink::quiet});

        const TreeLayout layout = layout_of(story);
        const double width = static_cast<double>(story.cells.size()),
                     step = std::min(slot, 300.0 / width);
        const auto place = [&](const Double2& p) {
            return at(left + 152 + step * (p.x - width / 2.0), 366 + 8.0 * p.y);
        };
        for (std::size_t i = 0; i < story.turns.size(); ++i)
            if (story.turns[i].parent != BspTree<2>::none)
                svg.line(place(layout.nodes[story.turns[i].parent]), place(layout.nodes[i]),
                         {.stroke = Ink::quiet});
        for (std::size_t i = 0; i < story.turns.size(); ++i)
            svg.circle(
                place(layout.nodes[i]), 3.6,
                {.stroke = {}, .fill = story.turns[i].splitter ? Ink::blue : Ink::vermillion});
        svg.end_group();
        svg.text(at(left + 152, 590),
                 fmt::format("{} nodes, depth {}", story.turns.size(), story.tree.depth()), {});
    };
    panel(8, {.splitter = BspConfig::SplitterChoice::first}, "only the sides' own lines", "chain");
    panel(328, {.splitter = BspConfig::SplitterChoice::free, .candidates = 2, .lopsided = 0.2},
          "with free lines", "free");
    return svg;
}

}  // namespace space::ch03
