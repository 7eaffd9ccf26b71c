// Figure 6 of Heinonen16: an axis-aligned box and an oriented one around the same points.

#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/oriented_bounds.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/tight_box.hpp"
#include "common/program/plane_view.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace space::ch07 {
namespace {

constexpr double tilted_width = 15.0, tilted_height = 11.0, tilted_scale = 21.0;

/// Within a thin strip from the lower left to the upper right.
std::vector<Point2> tilted_points() {
    Pcg32 random(6);
    const Double2 along(0.85, 0.5268), across(-along.y, along.x);
    std::vector<Point2> points;
    for (int i = 0; i < 40; ++i) {
        const double a = 12.4 * random.uniform_double();
        const double b = 1.5 * random.uniform_double() - 0.75;
        points.push_back(Point2(Double2(2.2, 2.2) + a * along + b * across));
    }
    return points;
}

/// Equally likely everywhere and in all directions, through the circle around the frame.
std::vector<Ray2> random_lines(std::size_t count) {
    Pcg32 random(61);
    std::vector<Ray2> lines;
    while (lines.size() < count) {
        const Double2 along(random_point<2>(random, {Point2(-1.0f), Point2(1.0f)}));
        const double square = glm::dot(along, along), away = 2.0 * random.uniform_double() - 1.0;
        if (square < 0.01 || square > 1.0) continue;
        const Double2 u = along / std::sqrt(square), v(-u.y, u.x);
        const Double2 middle(0.5 * tilted_width, 0.5 * tilted_height);
        lines.push_back({.origin = Point2(middle + away * glm::length(middle) * v),
                         .direction = Vector2(u),
                         .tmin = -infinity});
    }
    return lines;
}

/// What of the line is in the frame.
void draw_line(Svg& svg, const PlaneView& view, const Ray2& line, const Style& style) {
    double from = -1e3, to = 1e3;
    const Double2 o(line.origin), d(line.direction), size(tilted_width, tilted_height);
    for (int axis = 0; axis < 2; ++axis) {
        const double a = -o[axis] / d[axis], b = (size[axis] - o[axis]) / d[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    if (from < to) svg.line(view(o + from * d), view(o + to * d), style);
}

std::vector<Double2> outline(const OrientedBounds<2>& box) {
    const auto c = corners(box);
    return {c[0], c[1], c[3], c[2]};
}

/// What panels share.
struct Boxes {
    std::vector<Point2> points = tilted_points();
    OrientedBounds<2> aligned = bounds_along<2>(Frame<2>(1.0), points),
                      tight = tight_box<2>(points);
};

/// A line that meets the box and not the tight one comes in vain.
void draw_panel(Svg& svg, double left, const char* name, const OrientedBounds<2>& box,
                const Boxes& boxes) {
    const PlaneView view{.corner = {left, 34}, .scale = tilted_scale, .size = tilted_height};
    svg.text(at(left + 0.5 * tilted_scale * tilted_width, 22), name, {.bold = true});
    svg.polygon(view(outline(box)), {.stroke = Ink::blue, .fill = Ink::sky, .opacity = 0.3});
    for (const Ray2& line : random_lines(20)) {
        const bool comes = meets(line, box), in_vain = comes && !meets(line, boxes.tight);
        draw_line(svg, view, line,
                  {.stroke = in_vain ? Ink::vermillion
                             : comes ? Ink::green
                                     : Ink::faint,
                   .dashed = !comes});
    }
    for (const Point2& p : boxes.points)
        svg.circle(view(Double2(p)), 4, {.stroke = Ink::paper, .fill = Ink::ink});
    std::size_t met = 0, all = 0;
    for (const Ray2& line : random_lines(100'000)) {
        met += meets(line, box);
        all += meets(line, boxes.aligned);
    }
    const double x = left + 0.5 * tilted_scale * tilted_width,
                 y = 34 + tilted_scale * tilted_height;
    svg.text(at(x, y + 28),
             fmt::format("boundary {:.1f}, area {:.1f}", surface(box), content(box)));
    svg.text(at(x, y + 54), fmt::format("meets {:.0f} % of the lines through a",
                                        100.0 * double(met) / double(all)));
}

}  // namespace

Svg fig_07_11(const Options&) {
    const Boxes boxes;
    Svg svg(
        "Points in a slanting strip in an axis-aligned box and in an oriented one, with lines "
        "that meet the boxes",
        656, 34 + tilted_scale * tilted_height + 68);
    draw_panel(svg, 4, "a. axis-aligned", boxes.aligned, boxes);
    draw_panel(svg, 656 - 4 - tilted_scale * tilted_width, "b. oriented", boxes.tight, boxes);
    return svg;
}

}  // namespace space::ch07
