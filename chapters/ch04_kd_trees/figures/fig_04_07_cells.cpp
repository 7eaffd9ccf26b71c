// The cells of three rules over one scene.

#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace space::ch04 {
namespace {

constexpr double cells_size = 12.0, cells_side = 208;

/// The walls of a room, and two rings of short segments in it: much detail in little space.
std::vector<Segment> room_with_rings() {
    std::vector<Segment> segments{{{0.5f, 0.5f}, {11.5f, 0.5f}},
                                  {{11.5f, 0.5f}, {11.5f, 11.5f}},
                                  {{11.5f, 11.5f}, {0.5f, 11.5f}},
                                  {{0.5f, 11.5f}, {0.5f, 0.5f}},
                                  {{0.5f, 7.5f}, {4.0f, 11.5f}}};
    const auto add_ring = [&](Double2 middle, double radius, int count) {
        const auto corner = [&](int i) {
            const double angle = 2.0 * std::numbers::pi * i / count;
            return Point2(middle + radius * Double2(std::cos(angle), std::sin(angle)));
        };
        for (int i = 0; i < count; ++i) segments.push_back({corner(i), corner(i + 1)});
    };
    add_ring({8.6, 3.1}, 1.1, 24);
    add_ring({8.6, 3.1}, 0.5, 12);
    add_ring({4.4, 5.2}, 0.4, 10);
    return segments;
}

void draw_panel(Svg& svg, const Story& story, const char* name, double left) {
    const PlaneView view{
        .corner = {left, 34}, .scale = cells_side / cells_size, .size = cells_size};
    svg.text(at(left + 0.5 * cells_side, 22), name, {.size = 18, .bold = true});
    for (const Turn& turn : story.turns) {
        if (!turn.split && turn.set.empty())
            svg.polygon(view(corners_of(turn.cell)),
                        {.stroke = {}, .fill = Ink::sky, .opacity = 0.35});
        if (!turn.split) continue;
        const auto [from, to] = line_in_cell(turn.cell, *turn.split);
        svg.line(view(from), view(to), {.stroke = Ink::blue});
    }
    for (const Segment& segment : story.segments)
        svg.line(view(Double2(segment.a)), view(Double2(segment.b)), {.stroke = Ink::ink});
    std::size_t leaves = 0;
    for (const Turn& turn : story.turns) leaves += !turn.split;
    svg.text(at(left + 0.5 * cells_side, 62 + cells_side), fmt::format("{} leaves", leaves),
             {.size = 17});
    svg.text(at(left + 0.5 * cells_side, 86 + cells_side),
             fmt::format("cost {:.1f}", expected_cost(story)), {.size = 17});
}

}  // namespace

Svg fig_04_07(const Options&) {
    using Rule = KdTreeConfig::Rule;
    const std::vector<Segment> segments = room_with_rings();
    Svg svg(
        "The cells of three k-d trees over one scene: cut in the middle, at the median, by areas",
        656, 132 + cells_side - 34);
    double left = 4;
    for (const auto& [rule, name] : {std::pair{Rule::middle, "middle"},
                                     {Rule::median, "median"},
                                     {Rule::sah, "by areas (SAH)"}}) {
        draw_panel(svg, watched_build(segments, {.rule = rule, .max_leaf_size = 2}), name, left);
        left += cells_side + 12;
    }
    return svg;
}

}  // namespace space::ch04
