#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"

#include <fmt/format.h>

namespace space::ch03 {

Svg fig_03_02(const Options&) {
    const Story story = heinonen_story();
    Svg svg(
        "Seven segments A to G, cut by the lines of the splitters G, E, B and A; beside it, "
        "the sets that each splitter makes",
        640, 424);
    const PlaneView view{.corner = {8, 20}, .scale = 24, .size = heinonen_size};
    for (std::size_t i = 0; i < story.cells.size(); ++i)
        svg.polygon(view(story.cells[i].cell), cell_style(story, i), fmt::format("cell-{}", i + 1));
    svg.rect(view({0, heinonen_size}), at(384, 384), {.stroke = Ink::quiet});

    // The lines of the splitters that have something to part.
    for (std::size_t i = 0; i < story.turns.size(); ++i) {
        const Turn& turn = story.turns[i];
        const auto [from, to] = line_in_cell(story, i);
        const bool last = turn.set.size() == 1;
        svg.line(view(from), view(to), {.stroke = last ? Ink::quiet : Ink::blue, .dashed = last},
                 "line-" + story.pieces[turn.own.front()].name);
    }
    for (const std::size_t i : story.fragment_pieces) {
        const Piece& piece = story.pieces[i];
        draw_segment(svg, view, piece.from, piece.to, {.stroke = {}, .fill = Ink::ink});
        draw_front_tick(svg, view, piece.from, piece.to);
        svg.text(heinonen_name_place(view, piece), written(piece), {.size = 20, .halo = true},
                 "name-" + piece.name);
    }
    for (const Turn& turn : story.turns)
        for (const Turn::Cut& cut : turn.cuts)
            svg.circle(view(cut_point(story, cut)), 5, {.fill = Ink::vermillion});
    for (std::size_t i = 0; i < story.cells.size(); ++i)
        svg.text(moved(view(story.cells[i].place), 0, 6), fmt::format("{}", i + 1), {.size = 16});

    double y = 38;
    for (const Turn& turn : story.turns) {
        if (turn.set.size() == 1) continue;
        const auto line = [&](const std::string& text, double indent, const TextStyle& style) {
            svg.text(at(412 + indent, y), text, style);
            y += 26;
        };
        line("splitter " + written(story.pieces[turn.own.front()]), 0,
             {.anchor = Anchor::start, .size = 18, .bold = true});
        for (const Turn::Cut& cut : turn.cuts)
            line(fmt::format("cuts {} into {}, {}", written(story.pieces[cut.whole]),
                             written(story.pieces[cut.front]), written(story.pieces[cut.back])),
                 14, {.anchor = Anchor::start, .size = 18});
        line("in front " + written(story, turn.front), 14, {.anchor = Anchor::start, .size = 18});
        if (!turn.back.empty())
            line("behind " + written(story, turn.back), 14, {.anchor = Anchor::start, .size = 18});
        y += 8;
    }
    return svg;
}

}  // namespace space::ch03
