// M = T R S, step by step, and what another order or a mirror does.

#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/placed_house.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace space::ch09 {
namespace {

constexpr Double2 scale{1.5, 0.75}, to{4.25, 2};
constexpr double cosine = 0.8, sine = 0.6;

/// A linear map that is drawn: the axes' images, and where the origin is.
struct Stage {
    ObjectPlacement placement;
    std::string tells;
    bool is_mirror = false;
    /// For the wrong order: what the rotation is followed by.
    Double2 then_scale{1, 1};

    std::vector<Double2> of(const std::vector<Double2>& points) const {
        std::vector<Double2> result = placed(placement, points);
        for (Double2& p : result) p *= then_scale;
        return result;
    }
};

std::vector<Stage> stages() {
    const auto at = [](const Double2& t, double c, double s, const Double2& k) {
        return placed_in_plane(t, c, s, k);
    };
    return {
        {at({0, 0}, 1, 0, {1, 1}),
         "The house in its own space. Ticks are on the front sides of its walls: outside."},
        {at({0, 0}, 1, 0, scale),
         fmt::format("S: {} times as long along its own x axis, {} times along y.", scale.x,
                     scale.y)},
        {at({0, 0}, cosine, sine, scale),
         fmt::format("R after S: turned, with cosine {} and sine {}. Right angles stay right.",
                     cosine, sine)},
        {at(to, cosine, sine, scale),
         fmt::format("T after R: moved by ({}, {}). The product T R S is the object's matrix.",
                     to.x, to.y)},
        {at({0, 0}, cosine, sine, {1, 1}), "Another order: R first ...", false},
        {at({0, 0}, cosine, sine, {1, 1}),
         "... then S, along the world's axes: the angles of the house are no longer right.", false,
         scale},
        {at(to, cosine, sine, {-scale.x, scale.y}),
         "T R S with a negative scale along x: the chimney is on the other side, and the ticks, "
         "which follow the order of the corners, are inside.",
         true},
    };
}

}  // namespace

Svg fig_09_04(const Options&) {
    Svg svg(
        "A house that is scaled, then turned, then moved; the same in another order; and in a "
        "mirror",
        656, 420);
    const PlacedView view{.corner = {8, 8}, .scale = 80, .low = {-1.75, -1.6}, .size = {8, 5}};
    view.draw_frame(svg);
    draw_axes(svg, view, {}, Ink::quiet);
    const std::vector<Stage> all = stages();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Stage& stage = all[i];
        svg.begin_step_alone(i, all.size(), stage.tells);
        if (i > 0) draw_area(svg, view, house(), Ink::faint);
        const std::vector<Double2> axes = stage.of({{0, 0}, {1, 0}, {0, 1}});
        for (const std::size_t axis : {1u, 2u})
            svg.line(view(axes[0]), view(axes[axis]), {.stroke = Ink::blue, .arrow = true});
        draw_area(svg, view, stage.of(house()), Ink::sky);
        draw_walls(svg, view, stage.of(house()), Ink::ink,
                   stage.is_mirror ? Ink::vermillion : Ink::green);
        svg.end_group();
    }
    return svg;
}

}  // namespace space::ch09
