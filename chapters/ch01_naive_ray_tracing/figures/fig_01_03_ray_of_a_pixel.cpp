#include "chapters/ch01_naive_ray_tracing/figures.hpp"
#include "chapters/ch01_naive_ray_tracing/figures/parallel_view.hpp"
#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "common/camera.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

namespace space::ch01 {

namespace {

constexpr double t_min = 0.3, t_max = 3.6;

/// The axis of t: every mark stands below its point on the ray.
template <class OnRay>
void draw_t_axis(Svg& svg, const OnRay& on_ray, double hit_t) {
    svg.begin_group("t-axis");
    constexpr double axis_y = 370;
    const auto mark = [&](double t, const std::string& label, bool tied) {
        const Point2 p = on_ray(t);
        if (tied) svg.line(moved(p, 0, 8), {p.x, axis_y - 8}, {.stroke = Ink::faint});
        svg.line({p.x, axis_y - 8}, {p.x, axis_y + 8});
        svg.text({p.x, axis_y + 30}, label, {.size = 18});
    };
    svg.polygon({{on_ray(t_min).x, axis_y - 6},
                 {on_ray(t_max).x, axis_y - 6},
                 {on_ray(t_max).x, axis_y + 6},
                 {on_ray(t_min).x, axis_y + 6}},
                {.stroke = {}, .fill = Ink::green, .opacity = 0.45}, "interval");
    svg.line({on_ray(0).x, axis_y}, {620, axis_y}, {.arrow = true});
    mark(0, "0", true);
    mark(t_min, "*t*_{min}", false);
    mark(1, "1", true);
    mark(hit_t, fmt::format("*t* = {}", shown(hit_t, 2)), true);
    mark(t_max, "*t*_{max}", false);
    svg.text({620, axis_y - 14}, "*t*", {.size = 20});
    svg.end_group();
}

}  // namespace

Svg fig_01_03(const Options&) {
    Svg svg(
        "The ray from the eye through the centre of a pixel to a triangle, and the axis of t "
        "below it",
        640, 416);
    constexpr int width = 8, height = 6, pixel_x = 5, pixel_y = 2;
    const Camera camera{
        .eye = {0.0f, 0.0f, 0.0f}, .target = {0.0f, 0.0f, -1.0f}, .field_of_view = 60.0f};
    const PixelGrid grid(camera, width, height);
    const Ray ray = grid.ray(pixel_x, pixel_y);
    const Triangle triangle{{-0.6f, -0.3f, -3.0f}, {1.3f, -0.4f, -2.9f}, {0.6f, 1.0f, -2.8f}};
    const Hit hit = MollerTrumbore::intersect(ray, triangle).value();

    const ParallelView view{{56, 218}, 138, 8.0 / 17, 15.0 / 17, 12.0 / 13, 5.0 / 13};
    const auto on_image = [&](double x, double y) {
        return view(Double3(grid.ray_through(x, y).at(1.0f)));
    };
    const auto on_ray = [&](double t) {
        return view(Double3(ray.origin) + t * Double3(ray.direction));
    };

    // From back to front.
    svg.line(on_ray(hit.t), on_ray(t_max),
             {.stroke = Ink::vermillion, .dashed = true, .arrow = true});
    svg.polygon(view.outline({Double3(triangle.a), Double3(triangle.b), Double3(triangle.c)}),
                {.fill = Ink::sky, .opacity = 0.55}, "triangle");
    svg.line(on_ray(1.0), on_ray(hit.t), {.stroke = Ink::vermillion});
    svg.begin_group("image-plane");
    svg.polygon({on_image(0, 0), on_image(width, 0), on_image(width, height), on_image(0, height)},
                {.fill = Ink::paper, .opacity = 0.7});
    svg.polygon({on_image(pixel_x, pixel_y), on_image(pixel_x + 1, pixel_y),
                 on_image(pixel_x + 1, pixel_y + 1), on_image(pixel_x, pixel_y + 1)},
                {.stroke = {}, .fill = Ink::yellow});
    for (int x = 0; x <= width; ++x)
        svg.line(on_image(x, 0), on_image(x, height), {.stroke = Ink::quiet});
    for (int y = 0; y <= height; ++y)
        svg.line(on_image(0, y), on_image(width, y), {.stroke = Ink::quiet});
    svg.end_group();
    svg.line(on_ray(0.0), on_ray(1.0), {.stroke = Ink::vermillion});
    for (const double t : {0.0, 1.0, double{hit.t}})
        svg.circle(on_ray(t), 5, {.stroke = {}, .fill = Ink::vermillion});

    svg.text(moved(on_ray(0), 0, -16), "*O*", {.size = 20});
    svg.text(moved(on_ray(hit.t), 26, 34), "*P* = *O* + *t D*",
             {.anchor = Anchor::start, .size = 20, .halo = true});
    svg.text(moved(on_image(0, 0), 0, -14), fmt::format("{} × {} pixels", width, height), {});
    const std::array<std::pair<Point3, const char*>, 3> names{
        {{triangle.a, "*a*"}, {triangle.b, "*b*"}, {triangle.c, "*c*"}}};
    for (const auto& [p, name] : names)
        svg.text(moved(view(Double3(p)), p.x < 0 ? -14 : 0,
                       p.y > 0   ? -12
                       : p.x < 0 ? 6
                                 : 24),
                 name, {.size = 20});

    draw_t_axis(svg, on_ray, hit.t);
    return svg;
}

}  // namespace space::ch01
