#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"

#include <fmt/format.h>

namespace space::ch04 {

Svg fig_04_02(const Options&) {
    const Story story = heinonen_story();
    Svg svg(
        "Seven segments A to G, cut by the planes q to v across the axes; beside it, the sets that "
        "each plane makes",
        640, 424);
    const PlaneView view{.corner = {8, 20}, .scale = 24, .size = heinonen_size};
    svg.rect(view({0, heinonen_size}), at(384, 384), {.stroke = Ink::quiet});
    for (const Turn& turn : story.turns)
        if (!turn.split)
            svg.polygon(view(corners_of(turn.cell)),
                        {.stroke = {},
                         .fill = turn.node % 2 == 0 ? Ink::sky : Ink::orange,
                         .opacity = 0.16});
    svg.polygon(view(corners_of(story.tree.box)), {.stroke = Ink::quiet, .dashed = true}, "box");
    for (const Turn& turn : story.turns) {
        if (!turn.split) continue;
        const auto [from, to] = line_in_cell(turn.cell, *turn.split);
        const std::string name = heinonen_plane_name(story, turn.node);
        svg.line(view(from), view(to), {.stroke = Ink::blue}, "plane-" + name);
        // Names stand outside of the box where the plane reaches it.
        const bool across_x = turn.split->axis == 0, to_top = to.y == double{story.tree.box.max.y};
        const Point2 place = !across_x ? moved(view(from), -14, 6)
                             : to_top  ? moved(view(to), 0, -8)
                                       : moved(view(from), 0, 20);
        svg.text(place, "*" + name + "*", {.ink = Ink::blue, .size = 20, .halo = true});
    }
    for (const NamedSegment& segment : story.named) {
        draw_segment(svg, view, segment.from, segment.to, {.stroke = {}, .fill = Ink::ink});
        svg.text(heinonen_name_place(view, segment), drawn_name(segment.name),
                 {.size = 20, .halo = true}, "name-" + segment.name);
    }
    double y = 38;
    for (const Turn& turn : story.turns) {
        if (!turn.split) continue;
        const auto line = [&](const std::string& text, double indent, const TextStyle& style) {
            svg.text(at(412 + indent, y), text, style);
            y += 20;
        };
        line(fmt::format("*{}*: *{}* = {}", heinonen_plane_name(story, turn.node),
                         turn.split->axis == 0 ? "x" : "y",
                         svg_number(double{turn.split->position})),
             0, {.anchor = Anchor::start, .ink = Ink::blue, .size = 18});
        line("below: " + drawn_set(story, turn.below), 14, {.anchor = Anchor::start, .size = 17});
        line("above: " + drawn_set(story, turn.above), 14, {.anchor = Anchor::start, .size = 17});
        y += 4;
    }
    return svg;
}

}  // namespace space::ch04
