// Points on the boundaries of cells: which cells name them if cells are open, closed, half-open.

#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures/plane_cells.hpp"

#include <fmt/format.h>

#include <functional>
#include <string>

namespace space::ch06 {
namespace {

constexpr std::uint32_t depth = 2, cells = 1u << depth;
constexpr double rule_side = 196;
const OrthtreeFrame<2> rule_frame{.corner = Double2(0.0), .edge = 8.0};

using Holds = std::function<bool(const OrthtreeCell<2>&, const Point2&)>;

bool is_in_open(const OrthtreeCell<2>& cell, const Point2& p) {
    const OrthtreeBox<2> box = rule_frame.box(cell);
    return p.x > box.min.x && p.x < box.max.x && p.y > box.min.y && p.y < box.max.y;
}
bool is_in_closed(const OrthtreeCell<2>& cell, const Point2& p) {
    const OrthtreeBox<2> box = rule_frame.box(cell);
    return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y;
}
bool is_in_half_open(const OrthtreeCell<2>& cell, const Point2& p) {
    return rule_frame.cell_of(p, depth) == cell;
}

/// How often a point is named, as a colour.
Ink ink_of(std::size_t names) {
    return names == 0 ? Ink::vermillion : names == 1 ? Ink::green : Ink::orange;
}

/// A tick from a point into each cell that names it.
struct Count {
    std::size_t names = 0, lost = 0;
};
void draw_point(Svg& svg, const PlaneView& view, const Point2& p, const Holds& holds,
                Count& count) {
    std::vector<Double2> into;
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x)
            if (const OrthtreeCell<2> cell{depth, {x, y}}; holds(cell, p))
                into.push_back(rule_frame.box(cell).centre());
    count.names += into.size();
    count.lost += into.empty();
    const Ink ink = ink_of(into.size());
    for (const Double2& centre : into) {
        const Double2 way = centre - Double2(p);
        const double length = glm::length(way);
        if (length > 0.0)
            svg.line(view(Double2(p)), view(Double2(p) + 0.42 / length * way), {.stroke = ink});
    }
    if (into.empty()) {
        const Point2 c = view(Double2(p));
        svg.line(moved(c, -4, -4), moved(c, 4, 4), {.stroke = ink});
        svg.line(moved(c, -4, 4), moved(c, 4, -4), {.stroke = ink});
    } else {
        svg.circle(view(Double2(p)), 4, {.stroke = Ink::paper, .fill = ink});
    }
}

void draw_panel(Svg& svg, double left, const char* name, const char* rule, const Holds& holds) {
    const PlaneView view{.corner = {left, 44}, .scale = rule_side / 8.0, .size = 8.0};
    svg.text(at(left + 0.5 * rule_side, 22), name, {.bold = true});
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x)
            svg.polygon(view(corners_of(rule_frame.box(OrthtreeCell<2>{depth, {x, y}}))),
                        {.stroke = Ink::faint});
    Count count;
    int points = 0;
    for (int y = 0; y <= 8; ++y)
        for (int x = 0; x <= 8; ++x, ++points) draw_point(svg, view, Point2(x, y), holds, count);
    svg.text(at(left + 0.5 * rule_side, 74 + rule_side), rule, {.size = 17});
    svg.text(at(left + 0.5 * rule_side, 98 + rule_side),
             count.lost > 0 ? fmt::format("{} of {} lost", count.lost, points)
                            : fmt::format("{} names for {} points", count.names, points),
             {.size = 17});
}

}  // namespace

Svg fig_06_02(const Options&) {
    Svg svg("81 points in 16 cells, most on boundaries, by open, closed and half-open cells", 672,
            106 + rule_side);
    draw_panel(svg, 10, "open", "low < *x* < high", is_in_open);
    draw_panel(svg, 238, "closed", "low ≤ *x* ≤ high", is_in_closed);
    draw_panel(svg, 466, "half-open", "low ≤ *x* < high", is_in_half_open);
    return svg;
}

}  // namespace space::ch06
