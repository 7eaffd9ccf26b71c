// One T, one R, one S, in the six orders that three things have.

#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/placed_house.hpp"

#include <string>
#include <vector>

namespace space::ch09 {
namespace {

constexpr Double2 stretched{1.75, 0.75}, by{2, 1};
constexpr double turn_cosine = 0.8, turn_sine = 0.6;

/// What a letter does to a point.
Double2 done(char letter, const Double2& p) {
    switch (letter) {
        case 'S':
            return stretched * p;
        case 'R':
            return to_world(placed_in_plane({0, 0}, turn_cosine, turn_sine, {1, 1}), p);
        default:
            return p + by;
    }
}

/// The letters as a product is written: the last one comes first.
std::vector<Double2> house_by(const std::string& product) {
    std::vector<Double2> points = house();
    for (Double2& p : points)
        for (std::size_t i = product.size(); i-- > 0;) p = done(product[i], p);
    return points;
}

}  // namespace

Svg fig_09_05(const Options&) {
    Svg svg("The same scaling, rotation and translation in all six orders", 656, 412);
    const std::vector<std::string> products{"TRS", "RTS", "TSR", "STR", "RST", "SRT"};
    for (std::size_t i = 0; i < products.size(); ++i) {
        const PlacedView view{.corner = {8.0 + 216.0 * double(i % 3), 34.0 + 206.0 * double(i / 3)},
                              .scale = 23.5,
                              .low = {-2.4, -2.0},
                              .size = {8.85, 7.0}};
        const std::string& p = products[i];
        svg.text(moved(Point2(view.corner), 104, -10),
                 std::string("*") + p[0] + " " + p[1] + " " + p[2] + "*",
                 {.ink = i == 0 ? Ink::green : Ink::ink, .size = 20, .bold = i == 0});
        view.draw_frame(svg);
        draw_axes(svg, view, {}, Ink::quiet);
        draw_area(svg, view, house(), Ink::faint);
        draw_area(svg, view, house_by(p), i == 0 ? Ink::green : Ink::blue);
    }
    return svg;
}

}  // namespace space::ch09
