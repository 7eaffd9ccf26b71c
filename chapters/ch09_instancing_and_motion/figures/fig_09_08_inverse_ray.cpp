// The inverse ray: an object with its box in the world, and both spaces with the same t.

#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/placed_house.hpp"
#include "chapters/ch09_instancing_and_motion/transformed_box.hpp"

#include <fmt/format.h>

#include <optional>
#include <vector>

namespace space::ch09 {
namespace {

/// A ray of the plane, with the t at which it ends.
struct PlaneRay {
    Double2 origin, direction;
    double end;
    Double2 at(double t) const { return origin + t * direction; }
};

void draw_ray(Svg& svg, const PlacedView& view, const PlaneRay& ray, const Interval& inside) {
    svg.line(view(ray.origin), view(ray.at(ray.end)), {.stroke = Ink::vermillion, .arrow = true});
    for (int t = 0; t < int(ray.end); ++t) {
        svg.circle(view(ray.at(t)), 4.5, {.stroke = {}, .fill = Ink::vermillion});
        svg.text(moved(view(ray.at(t)), 0, 28), fmt::format("{}", t),
                 {.ink = Ink::vermillion, .halo = true});
    }
    for (const float t : {inside.enter, inside.leave})
        svg.circle(view(ray.at(double{t})), 6, {.stroke = Ink::green, .fill = Ink::paper});
}

}  // namespace

Svg fig_09_08(const Options&) {
    Svg svg("A ray and a turned house in the world, and both in the house's own space", 656, 398);
    const ObjectPlacement placement = placed_in_plane({4.1, 2.9}, 0.8, 0.6, {1.5, 0.75});
    const PlaneRay world{{0.3, 3.3}, {1.75, -0.25}, 3.2};
    const PlaneRay local{Double2(placement.to_local(Double3(world.origin, 0))),
                         Double2(placement.direction_to_local(Double3(world.direction, 0))),
                         world.end};
    const std::optional<Interval> inside =
        SlabSafe::intersect(Ray{.origin = Point3(Double3(local.origin, 0)),
                                .direction = Vector3(Double3(local.direction, 0))},
                            house_box());
    const std::vector<Double2> box = corners_of(house_box());

    const PlacedView left{.corner = {8, 34}, .scale = 46, .low = {0, 0}, .size = {7.3, 5.8}},
        right{.corner = {360, 34}, .scale = 46, .low = {-3.1, -2.15}, .size = {6.25, 5.8}};
    svg.text(at(8 + 23 * 7.3, 22), "the world", {.bold = true});
    svg.text(at(360 + 23 * 6.25, 22), "the house's own space", {.bold = true});
    left.draw_frame(svg);
    right.draw_frame(svg);
    draw_area(svg, left, corners_of(transformed_box(affine(placement), house_box())), Ink::orange,
              true);
    draw_area(svg, left, placed(placement, box), Ink::blue);
    draw_area(svg, right, box, Ink::blue);
    draw_walls(svg, left, placed(placement, house()), Ink::ink, Ink::quiet);
    draw_walls(svg, right, house(), Ink::ink, Ink::quiet);
    draw_ray(svg, left, world, *inside);
    draw_ray(svg, right, local, *inside);
    svg.text(at(328, 34 + 46 * 5.8 + 30),
             fmt::format("In both, the ray is in the house's box from *t* = {:.3f} to {:.3f}",
                         inside->enter, inside->leave));
    const std::optional<Interval> loose =
        SlabSafe::intersect(Ray{.origin = Point3(Double3(world.origin, 0)),
                                .direction = Vector3(Double3(world.direction, 0))},
                            transformed_box(affine(placement), house_box()));
    svg.text(at(328, 34 + 46 * 5.8 + 58),
             fmt::format("in the box of the turned box (dashed) from {:.3f} to {:.3f}",
                         loose->enter, loose->leave));
    return svg;
}

}  // namespace space::ch09
