// The box of a turned box, for four angles; and the box of what is in it.

#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/placed_house.hpp"
#include "chapters/ch09_instancing_and_motion/transformed_box.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace space::ch09 {
namespace {

double area(const Aabb& box) {
    return double{box.extent().x} * double{box.extent().y};
}

/// A house of half the width, turned by so many degrees.
void draw_turned(Svg& svg, double left, double degrees) {
    const PlacedView view{
        .corner = {left, 34}, .scale = 48, .low = {-1.62, -1.75}, .size = {3.24, 3.5}};
    const double angle = degrees * std::numbers::pi / 180.0;
    const ObjectPlacement placement =
        placed_in_plane({0, 0}, std::cos(angle), std::sin(angle), {0.625, 1.125});
    const Affine m = affine(placement);
    const Aabb boxed = transformed_box(m, house_box());
    Aabb tight;
    for (const Double2& p : placed(placement, house())) tight.extend(Point3(Double3(p, 0.0)));
    const double turned = area(house_box()) * placement.scale.x * placement.scale.y;

    const double x = left + 24 * view.size.x, y = 34 + 48 * view.size.y;
    svg.text(at(x, 22), fmt::format("{}°", degrees), {.bold = true});
    draw_area(svg, view, corners_of(boxed), Ink::orange, true);
    draw_area(svg, view, placed(placement, corners_of(house_box())), Ink::blue);
    draw_area(svg, view, corners_of(tight), Ink::green);
    draw_walls(svg, view, placed(placement, house()), Ink::ink, Ink::quiet);
    svg.text(at(x, y + 26), fmt::format("boxed: {:.2f}", area(boxed) / turned));
    svg.text(at(x, y + 50), fmt::format("tight: {:.2f}", area(tight) / turned),
             {.ink = Ink::green});
}

}  // namespace

Svg fig_09_07(const Options&) {
    Svg svg("A house and its box, turned by four angles, with the box of the turned box", 656, 262);
    double left = 4;
    for (const double degrees : {0.0, 15.0, 30.0, 45.0}) {
        draw_turned(svg, left, degrees);
        left += 164;
    }
    return svg;
}

}  // namespace space::ch09
