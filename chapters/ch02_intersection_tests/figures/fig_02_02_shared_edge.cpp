#include "chapters/ch02_intersection_tests/figures.hpp"
#include "chapters/ch02_intersection_tests/figures/pixel.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/program/image.hpp"

#include <fmt/format.h>

#include <array>
#include <tuple>
#include <utility>

namespace space::ch02 {
namespace {

/// A quadrilateral, cut along the diagonal from a to c.
constexpr Point3 corner_a{-1.0625f, -1.125f, -0.125f}, corner_b{0.75f, -0.875f, 0.0625f},
    corner_c{1.1875f, 1.0625f, 0.0f}, corner_d{-1.0625f, 0.8125f, -0.125f};
constexpr Triangle lower{corner_a, corner_b, corner_c}, upper{corner_a, corner_c, corner_d};

/// Meets the diagonal at t = 1.
constexpr Ray aim{.origin = {3.0f, 2.0f, 5.0f}, .direction = {-2.26249981f, -1.375f, -5.0250001f}};

struct SharedEdge {
    Image image{0, 0};
    int neither = 0;
};

/// Rays in directions next to that of `aim`: which triangle says that it is hit?
template <class Test>
SharedEdge shared_edge(int side) {
    constexpr float step =
        0x1p-22f;  // between neighbouring floats of direction.x; every other one of direction.y
    SharedEdge result{.image = Image(side, side)};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const Vector3 offset(static_cast<float>(x - side / 2) * step,
                                 static_cast<float>(side / 2 - y) * step, 0.0f);
            const Ray ray{.origin = aim.origin, .direction = aim.direction + offset};
            const bool hits_lower = Test::intersect(ray, lower).has_value(),
                       hits_upper = Test::intersect(ray, upper).has_value();
            result.neither += !hits_lower && !hits_upper;
            result.image.at(x, y) = pixel(hits_lower && hits_upper ? Ink::blue
                                          : hits_lower             ? Ink::sky
                                          : hits_upper             ? Ink::yellow
                                                                   : Ink::vermillion);
        }
    return result;
}

void draw_legend(Svg& svg) {
    const std::array<std::tuple<float, Ink, const char*>, 4> legend{
        {{10, Ink::sky, "only *a b c*"},
         {176, Ink::yellow, "only *a c d*"},
         {342, Ink::blue, "both"},
         {446, Ink::vermillion, "neither: a leak"}}};
    for (const auto& [left, ink, label] : legend) {
        // A picture, as those above it: neither changes its colours on a dark page.
        Image swatch(1, 1);
        swatch.at(0, 0) = pixel(ink);
        svg.picture({left, 533}, {20, 20}, swatch, fmt::format("legend-{}", left));
        svg.rect({left, 533}, {20, 20}, {.stroke = Ink::quiet});
        svg.text({left + 28, 549}, label, {.anchor = Anchor::start, .size = 17});
    }
}

}  // namespace

Svg fig_02_02(const Options&) {
    Svg svg(
        "Two triangles with a common edge, and the rays about it under a magnifying glass, for "
        "three tests",
        640, 566);
    const auto view = [](const Point3& p) { return at(150 + 110 * p.x, 132 - 100 * p.y); };
    svg.polygon({view(corner_a), view(corner_b), view(corner_c)},
                {.fill = Ink::sky, .opacity = 0.6}, "lower");
    svg.polygon({view(corner_a), view(corner_c), view(corner_d)},
                {.fill = Ink::yellow, .opacity = 0.6}, "upper");
    const Point2 a = view(corner_a), c = view(corner_c);
    const Vector2 along = glm::normalize(c - a), across(-along.y, along.x);
    const auto beside = [&](float share, float distance) {
        return a + share * (c - a) + distance * across;
    };
    svg.line(beside(0.62f, 14), beside(0.3f, 14), {.stroke = Ink::blue, .arrow = true});
    svg.line(beside(0.3f, -14), beside(0.62f, -14), {.stroke = Ink::vermillion, .arrow = true});
    svg.circle(view(aim.at(1.0f)), 9, {.stroke = Ink::ink}, "glass");
    const std::array<std::pair<Point2, const char*>, 4> names{
        {{moved(a, -14, 2), "*a*"},
         {moved(view(corner_b), 14, 14), "*b*"},
         {moved(c, 14, 0), "*c*"},
         {moved(view(corner_d), -14, 2), "*d*"}}};
    for (const auto& [where, name] : names) svg.text(where, name, {.size = 20});
    svg.text({318, 62}, "*a b c* asks: left of *c* → *a*?",
             {.anchor = Anchor::start, .ink = Ink::blue});
    svg.text({318, 92}, "*a c d* asks: left of *a* → *c*?",
             {.anchor = Anchor::start, .ink = Ink::vermillion});
    svg.text({318, 136}, "Exactly:", {.anchor = Anchor::start});
    svg.text({318, 162}, "*E*_{ca} = −*E*_{ac}:", {.anchor = Anchor::start, .size = 20});
    svg.text({318, 192}, "one of the two says yes.", {.anchor = Anchor::start});
    svg.text({318, 218}, "Rounded: see below.", {.anchor = Anchor::start});

    constexpr int side = 40;
    constexpr float size = 200;
    const auto panel = [&](float left, const char* name, const SharedEdge& edge) {
        svg.picture({left, 260}, {size, size}, edge.image, name);
        svg.rect({left, 260}, {size, size}, {.stroke = Ink::quiet});
        svg.text({left + size / 2, 484}, name, {.size = 17, .bold = true});
        svg.text({left + size / 2, 508},
                 edge.neither ? fmt::format("{} leaks", edge.neither) : "no leak",
                 {.ink = edge.neither ? Ink::vermillion : Ink::ink, .size = 17});
    };
    panel(4, "Möller–Trumbore", shared_edge<MollerTrumboreFloat>(side));
    panel(220, "watertight", shared_edge<Watertight>(side));
    panel(436, "exact", shared_edge<FilteredExact>(side));
    draw_legend(svg);
    return svg;
}

}  // namespace space::ch02
