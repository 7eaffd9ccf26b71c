#include "chapters/ch09_instancing_and_motion/figures/drawn_placing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace space::ch09 {
namespace {

/// A linear map that is drawn: the axes' images, and where the origin is.
struct Stage {
    ObjectPlacement placement;
    std::string tells;
    /// For the wrong order: what the rotation is followed by.
    Double2 then_scale{1, 1};

    std::vector<Double2> of(const std::vector<Double2>& points) const {
        std::vector<Double2> result = placed(placement, points);
        for (Double2& p : result) p *= then_scale;
        return result;
    }
    bool is_mirrored() const {
        return placement.is_mirrored() != (then_scale.x * then_scale.y < 0.0);
    }
};

std::vector<Stage> stages(const PlacedBy& by) {
    const auto& [to, cosine, sine, scale] = by;
    const Double2 mirrored{-scale.x, scale.y};
    // The product of S R's columns, (s_x c, s_y s) and (-s_x s, s_y c), is c s (s_y^2 - s_x^2).
    const bool stays_right = scale.x * scale.x == scale.y * scale.y || cosine * sine == 0.0;
    return {
        {placed_in_plane({0, 0}, 1, 0, {1, 1}),
         "The house in its own space. Ticks are on the front sides of its walls: outside."},
        {placed_in_plane({0, 0}, 1, 0, scale),
         fmt::format("S: {} times as long along its own x axis, {} times along y.",
                     svg_number(scale.x), svg_number(scale.y))},
        {placed_in_plane({0, 0}, cosine, sine, scale),
         fmt::format("R after S: turned, with cosine {} and sine {}. Right angles stay right.",
                     svg_number(cosine), svg_number(sine))},
        {placed_in_plane(to, cosine, sine, scale),
         fmt::format("T after R: moved by ({}, {}). The product T R S is the object's matrix.",
                     svg_number(to.x), svg_number(to.y))},
        {placed_in_plane({0, 0}, cosine, sine, {1, 1}), "Another order: R first ..."},
        {placed_in_plane({0, 0}, cosine, sine, {1, 1}),
         fmt::format("... then S, along the world's axes: the angles of the house are {} right.",
                     stays_right ? "still" : "no longer"),
         scale},
        {placed_in_plane(to, cosine, sine, mirrored),
         mirrored.x * mirrored.y < 0.0
             ? fmt::format(
                   "T R S with a negative scale along {}: the chimney is on the other "
                   "side, and the ticks, which follow the order of the corners, are inside.",
                   mirrored.x < 0.0 ? "x" : "y")
             : "T R S with the other sign along x: no mirror, or two, and the ticks are outside."},
    };
}

/// The part of a figure that is in the frame.
ConvexCell in_frame(const PlacedView& view, ConvexCell corners) {
    for (int axis = 0; axis < 2; ++axis) {
        const double low = view.low[axis], high = low + view.size[axis];
        corners = part_above(corners, [&](const Double2& p) { return p[axis] - low; });
        corners = part_above(corners, [&](const Double2& p) { return high - p[axis]; });
    }
    return corners;
}
/// The part of a line that is in the frame; none where it lies outside.
std::optional<std::array<Double2, 2>> in_frame(const PlacedView& view, const Double2& a,
                                               const Double2& b) {
    double enter = 0.0, leave = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        const double way = b[axis] - a[axis], low = view.low[axis] - a[axis],
                     high = low + view.size[axis];
        if (way == 0.0 && (low > 0.0 || high < 0.0)) return {};
        if (way == 0.0) continue;
        enter = std::max(enter, std::min(low / way, high / way));
        leave = std::min(leave, std::max(low / way, high / way));
    }
    if (enter >= leave) return {};
    return {{enter == 0.0 ? a : a + enter * (b - a), leave == 1.0 ? b : a + leave * (b - a)}};
}

}  // namespace

Svg drawn_placing(const PlacedBy& by) {
    Svg svg(
        "A house that is scaled, then turned, then moved; the same in another order; and in a "
        "mirror",
        656, 424);
    const PlacedView& view = placing_view;
    view.draw_frame(svg);
    draw_axes(svg, view, {}, Ink::quiet);
    const std::vector<Stage> all = stages(by);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Stage& stage = all[i];
        svg.begin_step_alone(i, all.size(), stage.tells);
        if (i > 0) draw_area(svg, view, house(), Ink::faint);
        const std::vector<Double2> axes = stage.of({{0, 0}, {1, 0}, {0, 1}});
        for (const std::size_t axis : {1u, 2u})
            if (const auto part = in_frame(view, axes[0], axes[axis]))
                svg.line(view((*part)[0]), view((*part)[1]),
                         {.stroke = Ink::blue, .arrow = (*part)[1] == axes[axis]});
        const std::vector<Double2> corners = stage.of(house());
        draw_area(svg, view, in_frame(view, corners), Ink::sky);
        for (std::size_t wall = 0; wall < corners.size(); ++wall)
            if (const auto part =
                    in_frame(view, corners[wall], corners[(wall + 1) % corners.size()]))
                draw_wall(svg, view, (*part)[0], (*part)[1], Ink::ink,
                          stage.is_mirrored() ? Ink::vermillion : Ink::green);
        svg.end_group();
    }
    return svg;
}

Double2 by_product(const PlacedBy& by, std::string_view product, const Double2& p) {
    Double2 q = p;
    for (std::size_t i = product.size(); i-- > 0;) {
        if (product[i] == 'S')
            q = by.scale * q;
        else if (product[i] == 'R')
            q = to_world(placed_in_plane({0, 0}, by.cosine, by.sine, {1, 1}), q);
        else
            q = q + by.translation;
    }
    return q;
}

Svg drawn_orders(const PlacedBy& by) {
    Svg svg("The same scaling, rotation and translation in all six orders", 656, 412);
    const std::vector<std::string> products{"TRS", "RTS", "TSR", "STR", "RST", "SRT"};
    for (std::size_t i = 0; i < products.size(); ++i) {
        PlacedView view = orders_view;
        view.corner += Double2(216.0 * double(i % 3), 206.0 * double(i / 3));
        const std::string& p = products[i];
        svg.text(moved(Point2(view.corner), 104, -10),
                 std::string("*") + p[0] + " " + p[1] + " " + p[2] + "*",
                 {.ink = i == 0 ? Ink::green : Ink::ink, .size = 20, .bold = i == 0});
        view.draw_frame(svg);
        draw_axes(svg, view, {}, Ink::quiet);
        draw_area(svg, view, house(), Ink::faint);
        std::vector<Double2> corners = house();
        for (Double2& corner : corners) corner = by_product(by, p, corner);
        draw_area(svg, view, in_frame(view, corners), i == 0 ? Ink::green : Ink::blue);
    }
    return svg;
}

}  // namespace space::ch09
