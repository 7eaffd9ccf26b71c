#include "chapters/ch04_kd_trees/figures/drawn_build.hpp"

#include "common/program/tree_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch04 {
namespace {

/// What a step is about: a turn of the builder; none at the start and at the end.
struct Step {
    std::size_t turn;
    bool placed;  ///< the halves have their sets
    std::string tells;
};

/// The page's steps of a turn; of a leaf there is one alone.
struct Steps {
    int chosen, placed;
};

/// The story, its steps, and where its parts stand on the paper.
class Stage {
  public:
    explicit Stage(const Story& story) : story_(story) { write_script(); }
    void draw(Svg& svg) const;

  private:
    void write_script();
    void add(std::size_t turn, bool placed, std::string tells) {
        steps_.push_back({turn, placed, std::move(tells)});
    }
    int next_step() const { return static_cast<int>(steps_.size()); }
    std::string plane(const Turn& turn) const {
        const std::string where =
            fmt::format("{} = {}", "xy"[turn.split->axis],
                        svg_number(static_cast<double>(turn.split->position)));
        return story_.plane_names.empty() ? where
                                          : heinonen_plane_name(story_, turn.node) + ": " + where;
    }
    std::string told_leaf(const Turn& turn) const;
    const Turn* turn_in(std::size_t step) const {
        return steps_[step].turn < story_.turns.size() ? &story_.turns[steps_[step].turn] : nullptr;
    }
    Ink ink_of(std::size_t step, std::uint32_t segment) const;
    Point2 place(std::uint32_t node) const { return paper_(layout_[node]); }

    void draw_cells(Svg& svg) const;
    void draw_planes(Svg& svg) const;
    void draw_segments(Svg& svg) const;
    void draw_waiting_sets(Svg& svg) const;
    void draw_nodes(Svg& svg) const;

    const Story& story_;
    std::vector<Double2> layout_ = layout_of(story_);
    TreePaper paper_{layout_, {352, 32}, {322, 276}};
    std::vector<Step> steps_;
    std::vector<Steps> of_turn_;
    PlaneView view_ = build_view();
};

std::string Stage::told_leaf(const Turn& turn) const {
    if (turn.set.empty()) return "Nothing lies in this cell: an empty leaf.";
    const std::string set = plain_set(story_, turn.set);
    const KdTreeConfig& config = story_.config;
    const bool by_cost = config.rule == KdTreeConfig::Rule::sah;
    std::string why = by_cost ? fmt::format("No plane is cheaper than to test {}", set)
                              : fmt::format("No plane in turn parts {} well enough", set);
    if (config.max_depth && turn.depth >= *config.max_depth)
        why = fmt::format("No cell may be deeper than that of {}", set);
    if (!by_cost && turn.set.size() <= config.max_leaf_size) why = set + " is few enough";
    return why + ": a leaf, which names what is in its cell.";
}

void Stage::write_script() {
    const std::size_t none = story_.turns.size();
    add(none, false,
        fmt::format("{} segments, and the box of them all: the root's cell. One cell waits.",
                    story_.segments.size()));
    for (std::size_t i = 0; i < story_.turns.size(); ++i) {
        const Turn& turn = story_.turns[i];
        const std::string set = plain_set(story_, turn.set);
        if (!turn.split) {
            of_turn_.push_back({next_step(), next_step()});
            add(i, true, told_leaf(turn));
            continue;
        }
        of_turn_.push_back({next_step(), next_step() + 1});
        add(i, false,
            fmt::format("The cell of {} is cut by the plane {}, one number and an axis.", set,
                        plane(turn)));
        add(i, true,
            fmt::format("Each segment's box is compared with it. Below: {}. Above: {}. Both cells "
                        "wait; the one below is next.",
                        plain_set(story_, turn.below), plain_set(story_, turn.above)));
    }
    add(none, true, "Nothing waits any more: " + told_size(story_));
}

Ink Stage::ink_of(std::size_t step, std::uint32_t segment) const {
    const Turn* turn = turn_in(step);
    if (!turn) return Ink::ink;
    const auto in = [&](const std::vector<std::uint32_t>& set) {
        return std::ranges::find(set, segment) != set.end();
    };
    if (!in(turn->set)) return Ink::quiet;
    if (!steps_[step].placed) return Ink::ink;
    if (in(turn->below) && in(turn->above)) return Ink::purple;
    return in(turn->below) ? Ink::blue : in(turn->above) ? Ink::vermillion : Ink::green;
}

/// The part of the plane that a step is about, and what the page tells.
void Stage::draw_cells(Svg& svg) const {
    const auto fill = [&](const Aabb2& cell, Ink ink, double opacity) {
        svg.polygon(view_(corners_of(cell)), {.stroke = {}, .fill = ink, .opacity = opacity});
    };
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        svg.begin_step_alone(k, steps_.size(), steps_[k].tells);
        const Turn* turn = turn_in(k);
        if (turn && turn->split && steps_[k].placed) {
            const auto [below, above] = halves(turn->cell, *turn->split);
            fill(below, Ink::sky, 0.4);
            fill(above, Ink::orange, 0.4);
        } else if (turn) {
            fill(turn->cell, Ink::green, 0.2);
        } else if (k > 0) {
            for (const Turn& leaf : story_.turns)
                if (!leaf.split) fill(leaf.cell, leaf.node % 2 == 0 ? Ink::sky : Ink::orange, 0.16);
        }
        svg.end_group();
    }
}

/// Planes stay from the step in which they are chosen.
void Stage::draw_planes(Svg& svg) const {
    svg.polygon(view_(corners_of(story_.tree.box)), {.stroke = Ink::quiet, .dashed = true});
    for (std::size_t i = 0; i < story_.turns.size(); ++i) {
        const Turn& turn = story_.turns[i];
        if (!turn.split) continue;
        const auto [from, to] = line_in_cell(turn.cell, *turn.split);
        svg.begin_step(of_turn_[i].chosen, of_turn_[i].placed);
        svg.line(view_(from), view_(to), {.stroke = Ink::green});
        svg.end_group();
        svg.begin_step(of_turn_[i].placed + 1);
        svg.line(view_(from), view_(to), {.stroke = Ink::blue});
        svg.end_group();
    }
}

void Stage::draw_segments(Svg& svg) const {
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        svg.begin_step_alone(k, steps_.size());
        for (std::uint32_t i = 0; i < story_.named.size(); ++i) {
            const NamedSegment& segment = story_.named[i];
            const Ink ink = ink_of(k, i);
            draw_segment(svg, view_, segment.from, segment.to, {.stroke = {}, .fill = ink});
            svg.text(heinonen_name_place(view_, segment), drawn_name(segment.name),
                     {.ink = ink, .size = 24, .halo = true});
        }
        svg.end_group();
    }
}

/// Sets wait where their nodes will be.
void Stage::draw_waiting_sets(Svg& svg) const {
    for (std::size_t i = 0; i < story_.turns.size(); ++i) {
        const Turn& turn = story_.turns[i];
        int since = 0;
        for (std::size_t p = 0; p < i; ++p) {
            const Turn& parent = story_.turns[p];
            const std::uint32_t below = story_.tree.nodes[parent.node].below();
            if (!parent.split || (turn.node | 1) != (below | 1)) continue;
            since = of_turn_[p].placed;
            svg.begin_step(since);
            svg.line(place(parent.node), place(turn.node),
                     {.stroke = turn.node == below ? Ink::blue : Ink::vermillion});
            svg.end_group();
        }
        svg.begin_step(since, of_turn_[i].chosen - 1);
        svg.text(moved(place(turn.node), 0, 16), drawn_set(story_, turn.set),
                 {.size = 20, .halo = true});
        svg.end_group();
    }
}

void Stage::draw_nodes(Svg& svg) const {
    for (std::size_t i = 0; i < story_.turns.size(); ++i) {
        const Turn& turn = story_.turns[i];
        const Point2 centre = place(turn.node);
        std::string name, letters;
        if (!turn.split)
            for (const std::uint32_t k : turn.set) letters += story_.named[k].name;
        for (const char c : letters) name += drawn_name(std::string(1, c));
        if (turn.split)
            name = story_.plane_names.empty() ? std::string("*") + "xy"[turn.split->axis] + "*"
                                              : "*" + heinonen_plane_name(story_, turn.node) + "*";
        const double needed = std::max(18.0, 9.0 * double(letters.size())),
                     half = std::min(paper_.shrunk(needed), 0.5 * paper_.slot - 1),
                     text_size = 24 * (turn.split ? paper_.shrunk(1) : half / needed);
        const auto node = [&](Ink ink) {
            const Style style{.stroke = ink, .fill = Ink::paper};
            if (turn.split)
                svg.circle(centre, paper_.shrunk(20), style);
            else
                svg.rect(moved(centre, -half, -paper_.shrunk(18)), at(2 * half, paper_.shrunk(36)),
                         style);
            svg.text(moved(centre, 0, paper_.shrunk(8)), name, {.ink = ink, .size = text_size});
        };
        svg.begin_step(of_turn_[i].chosen, of_turn_[i].placed);
        node(Ink::green);
        svg.end_group();
        svg.begin_step(of_turn_[i].placed + 1);
        node(Ink::ink);
        svg.end_group();
    }
}

void Stage::draw(Svg& svg) const {
    draw_cells(svg);
    svg.rect(view_({0, heinonen_size}), at(view_.scale * view_.size, view_.scale * view_.size),
             {.stroke = Ink::quiet});
    draw_planes(svg);
    draw_segments(svg);
    draw_waiting_sets(svg);
    draw_nodes(svg);
}

}  // namespace

PlaneView build_view() {
    return {.corner = {8, 10}, .scale = 21, .size = heinonen_size};
}

std::string told_size(const Story& story) {
    std::size_t leaves = 0, named = 0;
    for (const Turn& turn : story.turns)
        if (!turn.split) ++leaves, named += turn.set.size();
    return fmt::format(
        "{} planes and {} leaves. {}", story.turns.size() - leaves, leaves,
        named == story.segments.size()
            ? "No plane has met a segment, so each is in one leaf."
            : fmt::format("Planes have met segments: leaves name {} for {} segments.", named,
                          story.segments.size()));
}

Svg drawn_build(const Story& story) {
    Svg svg("The segments A to G and the k-d tree that the builder has made of them, step by step",
            676, 356);
    Stage(story).draw(svg);
    return svg;
}

}  // namespace space::ch04
