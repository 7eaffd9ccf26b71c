#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"

namespace space::ch04 {

Svg fig_04_03(const Options&) {
    const Story story = heinonen_story();
    const std::vector<Double2> layout = layout_of(story);
    Svg svg("The k-d tree of the segments A to G: inner nodes hold planes, leaves hold segments",
            640, 330);
    const auto place = [&](std::uint32_t node) {
        return at(26 + 84 * layout[node].x, 40 + 82 * layout[node].y);
    };
    for (const Turn& turn : story.turns) {
        if (!turn.split) continue;
        const std::uint32_t below = story.tree.nodes[turn.node].below();
        for (const bool is_above : {false, true}) {
            const Point2 from = place(turn.node), to = place(below + (is_above ? 1 : 0));
            svg.line(from, to);
            svg.text(moved(0.5f * (from + to), is_above ? 16 : -16, 0), is_above ? "+" : "−",
                     {.ink = Ink::quiet, .size = 20});
        }
    }
    for (const Turn& turn : story.turns) {
        const Point2 centre = place(turn.node);
        if (turn.split) {
            const std::string name = heinonen_plane_name(story, turn.node);
            svg.circle(centre, 20, {.stroke = Ink::blue, .fill = Ink::paper}, "node-" + name);
            svg.text(moved(centre, 0, 7), "*" + name + "*", {.ink = Ink::blue, .size = 22});
            const bool on_left = turn.node != 0 && turn.node % 2 == 0;
            if (turn.set.size() > 2)
                svg.text(moved(centre, on_left ? -28 : 28, -10), drawn_set(story, turn.set),
                         {.anchor = on_left ? Anchor::end : Anchor::start, .size = 18});
        } else {
            svg.rect(moved(centre, -18, -18), at(36, 36), {.fill = Ink::paper});
            svg.text(moved(centre, 0, 7), drawn_name(story.named[turn.set.front()].name),
                     {.size = 22});
        }
    }
    return svg;
}

}  // namespace space::ch04
