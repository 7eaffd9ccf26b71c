#include "chapters/ch09_instancing_and_motion/figures/placed_house.hpp"

#include <glm/geometric.hpp>

#include <cstddef>

namespace space::ch09 {

void PlacedView::draw_frame(Svg& svg) const {
    svg.rect(Point2(corner), Vector2(scale * size), {.stroke = Ink::faint});
}

ObjectPlacement placed_in_plane(const Double2& translation, double cosine, double sine,
                                const Double2& scale) {
    return {.translation = {translation, 0.0},
            .rotation = {Double3(cosine, sine, 0), Double3(-sine, cosine, 0), Double3(0, 0, 1)},
            .scale = {scale, 1.0}};
}

Double2 to_world(const ObjectPlacement& placement, const Double2& p) {
    return Double2(placement.to_world(Double3(p, 0.0)));
}

std::vector<Double2> house() {
    return {{-1, -1},     {-1, 0.25},   {0, 1},    {0.375, 0.75}, {0.375, 1.25},
            {0.75, 1.25}, {0.75, 0.45}, {1, 0.25}, {1, -1}};
}

Aabb house_box() {
    Aabb box;
    for (const Double2& p : house()) box.extend(Point3(Double3(p, 0.0)));
    return box;
}

std::vector<Double2> placed(const ObjectPlacement& placement, const std::vector<Double2>& points) {
    std::vector<Double2> result;
    for (const Double2& p : points) result.push_back(to_world(placement, p));
    return result;
}

void draw_wall(Svg& svg, const PlacedView& view, const Double2& from, const Double2& to, Ink ink,
               Ink tick) {
    draw_front_tick(svg, view.plane(), from - view.low, to - view.low, tick);
    draw_segment(svg, view.plane(), from - view.low, to - view.low, {.stroke = {}, .fill = ink});
}

void draw_walls(Svg& svg, const PlacedView& view, const std::vector<Double2>& corners, Ink ink,
                Ink ticks) {
    for (std::size_t i = 0; i < corners.size(); ++i)
        draw_wall(svg, view, corners[i], corners[(i + 1) % corners.size()], ink, ticks);
}

void draw_area(Svg& svg, const PlacedView& view, const std::vector<Double2>& corners, Ink ink,
               bool dashed) {
    std::vector<Point2> points;
    for (const Double2& p : corners) points.push_back(view(p));
    svg.polygon(points, {.stroke = ink, .fill = ink, .opacity = 0.12, .dashed = dashed});
}

void draw_axes(Svg& svg, const PlacedView& view, const ObjectPlacement& placement, Ink ink,
               const char* x, const char* y) {
    const auto axis = [&](const Double2& unit, const char* letter) {
        const Point2 from = view(to_world(placement, {0, 0})),
                     tip = view(to_world(placement, 1.5 * unit));
        svg.line(from, tip, {.stroke = ink, .arrow = true});
        svg.text(moved(tip + 13.0f * glm::normalize(tip - from), 0, 6), letter,
                 {.ink = ink, .size = 20, .halo = true});
    };
    axis({1, 0}, x);
    axis({0, 1}, y);
}

std::vector<Double2> corners_of(const Aabb& box) {
    const Double2 low(box.min.x, box.min.y), high(box.max.x, box.max.y);
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

}  // namespace space::ch09
