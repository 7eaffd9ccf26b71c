// A circle that is stretched: its normals by the matrix, and by the inverse's transpose.

#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/placed_house.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace space::ch09 {
namespace {

constexpr double stretch = 2.0;

/// Points all around the unit circle.
std::vector<Double2> circle(int count) {
    std::vector<Double2> points;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i + 0.5) / count;
        points.push_back({std::cos(angle), std::sin(angle)});
    }
    return points;
}

void draw_normal(Svg& svg, const PlacedView& view, const Double2& p, const Double2& normal,
                 Ink ink) {
    svg.line(view(p), view(p + 0.7 * glm::normalize(normal)), {.stroke = ink, .arrow = true});
}

}  // namespace

Svg fig_09_06(const Options&) {
    Svg svg("Normals of a circle, and of the ellipse that it becomes when it is stretched", 656,
            266);
    const glm::dmat3 m(Double3(stretch, 0, 0), Double3(0, 1, 0), Double3(0, 0, 1));
    const PlacedView before{
        .corner = {8, 8}, .scale = 64, .low = {-1.85, -1.95}, .size = {3.7, 3.9}},
        after{.corner = {250, 8}, .scale = 64, .low = {-3.1, -1.95}, .size = {6.2, 3.9}};
    for (const PlacedView* view : {&before, &after}) {
        std::vector<Double2> outline = circle(90);
        if (view == &after)
            for (Double2& p : outline) p.x *= stretch;
        view->draw_frame(svg);
        draw_area(svg, *view, outline, Ink::sky);
    }
    for (const Double2& p : circle(12)) {
        draw_normal(svg, before, p, p, Ink::ink);
        const Double2 there(m * Double3(p, 0));
        draw_normal(svg, after, there, Double2(m * Double3(p, 0)), Ink::vermillion);
        draw_normal(svg, after, there, Double2(world_normal(m, Double3(p, 0))), Ink::green);
    }
    svg.text(before({0, 0}), "*n*", {.size = 22});
    svg.text(moved(after({0, 0}), 0, -10), "*M n*", {.ink = Ink::vermillion, .size = 22});
    svg.text(moved(after({0, 0}), 0, 24), "*M*⁻ᵀ*n*", {.ink = Ink::green, .size = 22});
    return svg;
}

}  // namespace space::ch09
