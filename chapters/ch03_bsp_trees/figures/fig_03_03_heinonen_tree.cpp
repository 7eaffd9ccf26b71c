#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"

#include <fmt/format.h>

namespace space::ch03 {

Svg fig_03_03(const Options&) {
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
