#include "chapters/ch01_naive_ray_tracing/figures.hpp"
#include "chapters/ch01_naive_ray_tracing/figures/parallel_view.hpp"

#include <array>
#include <string>

namespace space::ch01 {

Svg fig_01_04(const Options&) {
    Svg svg(
        "The same triangle with its vertices in two orders: the normal points to opposite sides",
        640, 376);
    const auto draw = [&](double x, const Triangle& triangle, Ink ink, const char* first,
                          const char* second, std::string id) {
        const ParallelView view{{x, 170}, 118, 12.0 / 13, 5.0 / 13, 0.8, 0.6};
        const std::array<Double3, 3> corners{Double3(triangle.a), Double3(triangle.b),
                                             Double3(triangle.c)};
        const Double3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        const Double3 tip = middle + 1.2 * glm::normalize(normal(triangle));
        const bool front = view.faces(normal(triangle));

        svg.begin_group(id);
        const auto draw_normal = [&] {
            svg.line(view(middle), view(tip), {.stroke = ink, .arrow = true});
            svg.text(moved(view(tip), 16, front ? 6 : 0), "*n*",
                     {.anchor = Anchor::start, .ink = ink, .size = 20});
        };
        if (!front) draw_normal();
        svg.polygon(view.outline({corners[0], corners[1], corners[2]}),
                    {.fill = front ? Ink::sky : Ink::orange, .opacity = 0.4});
        // The way round, a little inside the outline.
        for (std::size_t i = 0; i < 3; ++i) {
            const auto inside = [&](const Double3& p) { return middle + 0.62 * (p - middle); };
            const Double3 from = inside(corners[i]), to = inside(corners[(i + 1) % 3]);
            svg.line(view(from + 0.12 * (to - from)), view(to - 0.12 * (to - from)),
                     {.stroke = Ink::ink, .arrow = true});
        }
        if (front) {
            draw_normal();
            svg.circle(view(middle), 4, {.stroke = {}, .fill = ink});
        }
        const std::array<const char*, 3> names{"*a*", "*b*", "*c*"};
        for (std::size_t i = 0; i < 3; ++i) {
            const Point2 p = view(corners[i]), out = p + 20.0f * glm::normalize(p - view(middle));
            svg.text(moved(out, 0, 6), names[i], {.size = 20});
        }
        svg.text({x, 330}, first, {.size = 18, .bold = true});
        svg.text({x, 356}, second, {.size = 18});
        svg.end_group();
    };
    const Point3 a{-1.0f, 0.0f, 0.5f}, b{0.8f, 0.0f, 0.9f}, c{0.4f, 0.0f, -0.9f};
    draw(160, {a, b, c}, Ink::blue, "counter-clockwise", "we see the front side", "front");
    svg.text({320, 30}, "*n* = (*b* \u2212 *a*) \u00d7 (*c* \u2212 *a*)", {.size = 20});
    draw(480, {a, c, b}, Ink::vermillion, "clockwise", "we see the back side", "back");
    return svg;
}

}  // namespace space::ch01
