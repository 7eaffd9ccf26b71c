#include "chapters/ch03_bsp_trees/figures/drawn_build.hpp"

#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"
#include "common/program/tree_layout.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch03 {
namespace {

/// For plain text.
std::string plain(const Piece& piece) {
    return plain_name(piece.name);
}
std::string plain(const Story& story, std::span<const std::size_t> set) {
    std::vector<std::string> names;
    for (const std::size_t piece : set) names.push_back(plain(story.pieces[piece]));
    return fmt::format("{{{}}}", fmt::join(names, ", "));
}

/// The page's steps of one turn of the builder.
struct Steps {
    int chosen, first_cut, placed;  ///< one node alone: all the same
};

/// What a step is about.
struct Step {
    std::size_t turn;  ///< of the builder; none at the start and at the end
    bool placed;       ///< the sets are made
    std::string tells;
};

struct BuildScript {
    std::vector<Step> steps;
    std::vector<Steps> of_turn;
};

BuildScript script_of(const Story& story) {
    const std::size_t none = story.turns.size();
    BuildScript script;
    script.steps.push_back(
        {none, false,
         fmt::format("{} segments; the ticks mark their fronts. The builder has one set of them, "
                     "and no node.{}",
                     story.tree.polygons.size(),
                     story.left_out() ? " What has no extent is left out." : "")});
    for (std::size_t i = 0; i < story.turns.size(); ++i) {
        const Turn& turn = story.turns[i];
        const std::string splitter = plain(story.splitter(i));
        std::string set = plain(story, turn.set);
        if (turn.parent != BspTree<2>::none)
            set += fmt::format(", {} {},", turn.in_front ? "in front of" : "behind",
                               plain(story.splitter(turn.parent)));
        const auto now = [&] { return static_cast<int>(script.steps.size()); };
        if (turn.set.size() == 1) {
            script.of_turn.push_back({now(), now(), now()});
            script.steps.push_back(
                {i, true,
                 fmt::format("The set {} becomes a node without children. Its line parts two "
                             "empty cells.",
                             set)});
            continue;
        }
        Steps steps{now(), now() + 1, now() + 1 + static_cast<int>(turn.cuts.size())};
        script.steps.push_back({i, false,
                                fmt::format("The set {} gets the splitter {}. Its line runs "
                                            "through the coloured part of the plane "
                                            "only.",
                                            set, splitter)});
        for (const Turn::Cut& cut : turn.cuts)
            script.steps.push_back(
                {i, false,
                 fmt::format(
                     "{0} lies across the line of {1} and is cut: {2} is in front of it, {3} "
                     "behind.",
                     plain(story.pieces[cut.whole]), splitter, plain(story.pieces[cut.front]),
                     plain(story.pieces[cut.back]))});
        const auto side = [&](const std::vector<std::size_t>& part) {
            return part.empty() ? std::string("nothing") : plain(story, part);
        };
        script.steps.push_back(
            {i, true,
             fmt::format("In front of {}: {}. Behind it: {}. {}.", splitter, side(turn.front),
                         side(turn.back),
                         turn.own.size() == 1
                             ? splitter + " itself stays in the node"
                             : plain(story, turn.own) + " lie in its line and stay in the node")});
        script.of_turn.push_back(steps);
    }
    script.steps.push_back({none, true, "No set is left. " + summed_up(story)});
    return script;
}

bool holds(const std::vector<std::size_t>& set, std::size_t piece) {
    return std::ranges::find(set, piece) != set.end();
}

/// What colour a piece has in a step.
Ink ink_of(const Story& story, const Step& step, std::size_t piece) {
    if (step.turn == story.turns.size()) return Ink::ink;
    const Turn& turn = story.turns[step.turn];
    if (holds(turn.own, piece)) return Ink::green;
    if (step.placed)
        return holds(turn.front, piece)  ? Ink::blue
               : holds(turn.back, piece) ? Ink::vermillion
                                         : Ink::quiet;
    const bool part = std::ranges::any_of(
        turn.cuts, [&](const Turn::Cut& cut) { return cut.front == piece || cut.back == piece; });
    return part || holds(turn.set, piece) ? Ink::ink : Ink::quiet;
}

/// The story, its script, and where its parts stand on the paper.
struct Stage {
    const Story& story;
    BuildScript script = script_of(story);
    TreeLayout layout = layout_of(story);
    int last = static_cast<int>(script.steps.size()) - 1;
    PlaneView view = build_view();
    TreePaper tree{static_cast<double>(layout.cells.size()),
                   static_cast<double>(layout.levels) - 1.0};

    const Step& step(int k) const { return script.steps[static_cast<std::size_t>(k)]; }
    /// What shows in step k only; at the end in the last one.
    void begin(Svg& svg, int k, std::string_view tells = {}) const {
        svg.begin_step_alone(static_cast<std::size_t>(k), script.steps.size(), tells);
    }
};

/// The part of the plane that a step is about, and what the page tells.
void draw_regions(Svg& svg, const Stage& stage) {
    for (int k = 0; k <= stage.last; ++k) {
        const Step& step = stage.step(k);
        stage.begin(svg, k, step.tells);
        if (k == stage.last)
            for (std::size_t i = 0; i < stage.story.cells.size(); ++i)
                svg.polygon(stage.view(stage.story.cells[i].cell), cell_style(stage.story, i));
        if (step.turn < stage.story.turns.size()) {
            const ConvexCell& cell = stage.story.turns[step.turn].cell;
            const auto& line = stage.story.tree.planes[stage.story.tree.nodes[step.turn].plane];
            if (step.placed) {
                svg.polygon(stage.view(part_of(cell, line, true)),
                            {.stroke = {}, .fill = Ink::sky, .opacity = 0.4});
                svg.polygon(stage.view(part_of(cell, line, false)),
                            {.stroke = {}, .fill = Ink::orange, .opacity = 0.4});
            } else {
                svg.polygon(stage.view(cell), {.stroke = {}, .fill = Ink::green, .opacity = 0.2});
            }
        }
        svg.end_group();
    }
}

/// Lines stay from the step in which they are chosen.
void draw_lines(Svg& svg, const Stage& stage) {
    for (std::size_t i = 0; i < stage.story.turns.size(); ++i) {
        const auto [from, to] = line_in_cell(stage.story, i);
        const bool alone = stage.story.turns[i].set.size() == 1;
        const Steps& steps = stage.script.of_turn[i];
        svg.begin_step(steps.chosen, steps.placed);
        svg.line(stage.view(from), stage.view(to), {.stroke = Ink::green});
        svg.end_group();
        svg.begin_step(steps.placed + 1);
        svg.line(stage.view(from), stage.view(to),
                 {.stroke = alone ? Ink::quiet : Ink::blue, .dashed = alone});
        svg.end_group();
    }
}

/// Pieces, in the step's colours: whole until they are cut.
void draw_pieces(Svg& svg, const Stage& stage) {
    std::vector<std::pair<int, int>> lives(stage.story.pieces.size(), {0, stage.last});
    for (std::size_t i = 0; i < stage.story.turns.size(); ++i)
        for (std::size_t c = 0; c < stage.story.turns[i].cuts.size(); ++c) {
            const Turn::Cut& cut = stage.story.turns[i].cuts[c];
            const int step = stage.script.of_turn[i].first_cut + static_cast<int>(c);
            lives[cut.whole].second = step - 1;
            lives[cut.front].first = lives[cut.back].first = step;
        }
    for (int k = 0; k <= stage.last; ++k) {
        stage.begin(svg, k);
        const Step& step = stage.step(k);
        for (std::size_t i = 0; i < stage.story.pieces.size(); ++i) {
            if (k < lives[i].first || k > lives[i].second) continue;
            const Piece& piece = stage.story.pieces[i];
            const Ink ink = ink_of(stage.story, step, i);
            draw_segment(svg, stage.view, piece.from, piece.to, {.stroke = {}, .fill = ink});
            draw_front_tick(svg, stage.view, piece.from, piece.to, ink);
            svg.text(heinonen_name_place(stage.view, piece), written(piece),
                     {.ink = ink, .size = 24, .halo = true});
        }
        if (step.turn < stage.story.turns.size())
            for (std::size_t c = 0; c < stage.story.turns[step.turn].cuts.size(); ++c)
                if (stage.script.of_turn[step.turn].first_cut + static_cast<int>(c) <= k)
                    svg.circle(
                        stage.view(cut_point(stage.story, stage.story.turns[step.turn].cuts[c])), 5,
                        {.fill = Ink::vermillion});
        svg.end_group();
    }
}

/// Sets wait where their nodes will be.
void draw_waiting_sets(Svg& svg, const Stage& stage) {
    for (std::size_t i = 0; i < stage.story.turns.size(); ++i) {
        const Turn& turn = stage.story.turns[i];
        const Steps& steps = stage.script.of_turn[i];
        const Point2 centre = stage.tree(stage.layout.nodes[i]);
        if (turn.parent != BspTree<2>::none) {
            const Point2 parent = stage.tree(stage.layout.nodes[turn.parent]);
            svg.begin_step(stage.script.of_turn[turn.parent].placed);
            svg.line(parent, centre, {.stroke = turn.in_front ? Ink::blue : Ink::vermillion});
            svg.end_group();
        }
        if (steps.chosen > 0) {
            const int waits_from =
                turn.parent == BspTree<2>::none ? 0 : stage.script.of_turn[turn.parent].placed;
            svg.begin_step(waits_from, steps.chosen - 1);
            svg.text(moved(centre, 0, 16 * stage.tree.shrink), written(stage.story, turn.set),
                     {.size = 20 * stage.tree.shrink, .halo = true});
            svg.end_group();
        }
    }
}

/// The empty cells at the bottom of the tree, numbered at the end.
void draw_cells(Svg& svg, const Stage& stage) {
    const double half = 14 * stage.tree.shrink;
    for (std::size_t i = 0; i < stage.story.cells.size(); ++i) {
        const Point2 from = stage.tree(stage.layout.nodes[stage.story.cells[i].node]),
                     to = stage.tree(stage.layout.cells[i]);
        svg.begin_step(stage.script.of_turn[stage.story.cells[i].node].placed);
        svg.line(from, to, {.stroke = Ink::quiet, .dashed = true});
        svg.rect(moved(to, -half, -half), at(2 * half, 2 * half),
                 {.stroke = Ink::quiet, .fill = Ink::paper});
        svg.end_group();
        svg.begin_step(stage.last);
        Style style = cell_style(stage.story, i);
        style.stroke = Ink::quiet;
        svg.rect(moved(to, -half, -half), at(2 * half, 2 * half), style);
        svg.text(moved(to, 0, 6 * stage.tree.shrink), fmt::format("{}", i + 1),
                 {.size = 18 * stage.tree.shrink});
        svg.text(moved(stage.view(stage.story.cells[i].place), 0, 6), fmt::format("{}", i + 1),
                 {.size = 18});
        svg.end_group();
    }
}

/// Nodes stay from the step in which their splitters are chosen.
void draw_nodes(Svg& svg, const Stage& stage) {
    const double shrink = stage.tree.shrink;
    for (std::size_t i = 0; i < stage.story.turns.size(); ++i) {
        const Steps& steps = stage.script.of_turn[i];
        const Point2 centre = stage.tree(stage.layout.nodes[i]);
        const std::string name = written(stage.story.splitter(i));
        const bool is_long = name.size() > std::string_view("*A*_{1}").size();
        const auto node = [&](Ink ink) {
            svg.circle(centre, 20 * shrink, {.stroke = ink, .fill = Ink::paper});
            svg.text(moved(centre, 0, 8 * shrink), name,
                     {.ink = ink, .size = (is_long ? 19 : 24) * shrink});
        };
        svg.begin_step(steps.chosen, steps.placed);
        node(Ink::green);
        svg.end_group();
        svg.begin_step(steps.placed + 1);
        node(Ink::ink);
        svg.end_group();
    }
}

}  // namespace

PlaneView build_view() {
    return {.corner = {8, 10}, .scale = 21, .size = heinonen_size};
}

std::string summed_up(const Story& story) {
    std::size_t cuts = 0;
    for (const Turn& turn : story.turns) cuts += turn.cuts.size();
    const std::string since = cuts == 0 ? " and"
                              : cuts == 1
                                  ? ", since one was cut, and"
                                  : fmt::format(", since they were cut {} times, and", cuts);
    return fmt::format("The tree has {} nodes for {} segments{} {} empty cells at its bottom.",
                       story.turns.size(), story.tree.polygons.size(), since, story.cells.size());
}

Svg drawn_build(std::string title, const Story& story) {
    const Stage stage{story};
    Svg svg(std::move(title), 676, 356);
    draw_regions(svg, stage);
    svg.rect(stage.view({0, heinonen_size}),
             at(stage.view.scale * stage.view.size, stage.view.scale * stage.view.size),
             {.stroke = Ink::quiet});
    draw_lines(svg, stage);
    draw_pieces(svg, stage);
    draw_waiting_sets(svg, stage);
    draw_cells(svg, stage);
    draw_nodes(svg, stage);
    return svg;
}

}  // namespace space::ch03
