#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/sketch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace space::ch03 {
// -------------------------------------------------------------------------------------------------
// 3.1 The plane of A .. G

Svg fig_03_01(const Options&) {
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
        svg.text(moved(view(story.cells[i].place), 0, 6), fmt::format("{}", i + 1),
                 {.ink = Ink::quiet, .size = 16});

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

// -------------------------------------------------------------------------------------------------
// 3.2 The tree of A .. G

Svg fig_03_02(const Options&) {
    const Story story = heinonen_story();
    const TreeLayout layout = layout_of(story);
    constexpr double slot = 70, level = 78, top = 34, left = 5;
    Svg svg(
        "The tree of the segments A to G: G at the root; squares are the empty cells at its bottom",
        640, top + level * static_cast<double>(layout.levels - 1) + 30);
    const auto place = [&](const Double2& p) { return at(left + slot * p.x, top + level * p.y); };
    for (std::size_t i = 0; i < story.turns.size(); ++i)
        if (story.turns[i].parent != BspTree<2>::none) {
            const Point2 from = place(layout.nodes[story.turns[i].parent]),
                         to = place(layout.nodes[i]);
            svg.line(from, to, {.stroke = story.turns[i].in_front ? Ink::blue : Ink::vermillion});
        }
    for (std::size_t i = 0; i < story.cells.size(); ++i) {
        const Point2 from = place(layout.nodes[story.cells[i].node]), to = place(layout.cells[i]);
        svg.line(from, to, {.stroke = Ink::quiet, .dashed = true});
        svg.rect(moved(to, -15, -15), at(30, 30), {.stroke = {}, .fill = Ink::paper});
        Style style = cell_style(story, i);
        style.stroke = Ink::quiet;
        svg.rect(moved(to, -15, -15), at(30, 30), style, fmt::format("cell-{}", i + 1));
        svg.text(moved(to, 0, 6), fmt::format("{}", i + 1), {.size = 17});
    }
    for (std::size_t i = 0; i < story.turns.size(); ++i) {
        const Turn& turn = story.turns[i];
        const Point2 centre = place(layout.nodes[i]);
        svg.circle(centre, 21, {.fill = Ink::paper}, "node-" + story.pieces[turn.own.front()].name);
        svg.text(moved(centre, 0, 7), written(story.pieces[turn.own.front()]), {.size = 21});
        if (turn.set.size() > 1)
            svg.text(moved(centre, turn.in_front || i == 0 ? 28 : -28, -8),
                     written(story, turn.set),
                     {.anchor = turn.in_front || i == 0 ? Anchor::start : Anchor::end,
                      .ink = Ink::quiet,
                      .size = 17});
    }
    svg.text({16, 30}, "left: behind", {.anchor = Anchor::start, .ink = Ink::vermillion});
    svg.text({16, 56}, "right: in front", {.anchor = Anchor::start, .ink = Ink::blue});
    return svg;
}

}  // namespace space::ch03
