// The split sphere: half bright, half dark, and what a step of the point uncovers on the disc below
// the hemisphere.

#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "common/program/svg.hpp"

#include <cmath>
#include <vector>

namespace space::ch11 {
namespace {

constexpr double split_radius = 130;

/// Points of a circle around `centre`, from one part of a turn to another, counter-clockwise from
/// the right.
std::vector<Point2> arc_around(Point2 centre, double from, double to) {
    std::vector<Point2> points;
    for (int i = 0; i <= 64; ++i) {
        const double turn = from + (to - from) * i / 64.0;
        const Double2 p = circle_point(turn - std::floor(turn));
        points.push_back(moved(centre, split_radius * p.x, -split_radius * p.y));
    }
    return points;
}

}  // namespace

Svg fig_11_14(const Options&) {
    constexpr double step = 0.16;  // of the radius
    Svg svg("A split sphere from the side, and the disc of its irradiance from above", 640, 330);
    const Point2 centre = at(160, 160), disc = at(480, 160);
    svg.polygon(arc_around(centre, 0.25, 0.75), {.stroke = {}, .fill = Ink::quiet, .opacity = 0.6});
    svg.polygon(arc_around(centre, -0.25, 0.25),
                {.stroke = {}, .fill = Ink::yellow, .opacity = 0.6});
    svg.circle(centre, split_radius);
    svg.line(moved(centre, -150, 0), moved(centre, 150, 0));
    svg.line(centre, moved(centre, 0, -70), {.arrow = true});
    svg.text(moved(centre, 14, -58), "*n*", {.size = 18});
    svg.circle(centre, 5, {.stroke = {}, .fill = Ink::ink});
    svg.circle(moved(centre, step * split_radius, 0), 5, {.stroke = {}, .fill = Ink::vermillion});
    svg.text(moved(centre, 0.5 * step * split_radius, 28), "d*x*", {.size = 18, .halo = true});
    svg.line(centre, moved(centre, -0.77 * split_radius, 0.64 * split_radius),
             {.stroke = Ink::quiet});
    svg.text(moved(centre, -44, 62), "*R*", {.size = 18});
    svg.text(at(160, 318), "from the side", {.ink = Ink::quiet, .size = 17});

    // Seen from a point a step to the right, the border moves to the left: more is bright.
    const double half_height = std::sqrt(1.0 - step * step) * split_radius;
    svg.polygon(arc_around(disc, 0.25, 0.75), {.stroke = {}, .fill = Ink::quiet, .opacity = 0.6});
    svg.polygon(arc_around(disc, -0.25, 0.25), {.stroke = {}, .fill = Ink::yellow, .opacity = 0.6});
    svg.polygon({moved(disc, 0, -split_radius), moved(disc, -step * split_radius, -half_height),
                 moved(disc, -step * split_radius, half_height), moved(disc, 0, split_radius)},
                {.stroke = {}, .fill = Ink::vermillion, .opacity = 0.7});
    svg.circle(disc, split_radius);
    svg.line(moved(disc, 0, -split_radius), moved(disc, 0, split_radius), {.dashed = true});
    svg.text(moved(disc, -0.5 * step * split_radius, -split_radius - 12), "d*x* / *R*",
             {.ink = Ink::vermillion, .size = 18});
    svg.text(at(480, 318), "the disc, from above", {.ink = Ink::quiet, .size = 17});
    return svg;
}

}  // namespace space::ch11
