#include "chapters/ch02_intersection_tests/figures/drawn_edge.hpp"

#include "chapters/ch02_intersection_tests/figures/pixel.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/program/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace space::ch02 {
namespace {

static_assert(drawn_test_names.size() == triangle_test_count);

constexpr std::array<Ink, 4> verdict_inks{Ink::vermillion, Ink::sky, Ink::yellow, Ink::blue};
constexpr std::array<std::string_view, 4> verdict_texts{"neither", "*a b c*", "*a c d*", "both"};
constexpr float size = static_cast<float>(glass_square) * glass_side;

Point2 view(const Point3& p) {
    return at(edge_zero.x + edge_unit.x * double{p.x}, edge_zero.y + edge_unit.y * double{p.y});
}

/// The triangles, the glass, and the two questions that they ask about their edge.
void draw_triangles(Svg& svg, const EdgeScene& scene) {
    const Point2 a = view(scene.a), c = view(scene.c);
    svg.polygon({a, view(scene.b), c}, {.fill = Ink::sky, .opacity = 0.6}, "lower");
    svg.polygon({a, c, view(scene.d)}, {.fill = Ink::yellow, .opacity = 0.6}, "upper");
    const Vector2 along = a == c ? Vector2(1.0f, 0.0f) : glm::normalize(c - a),
                  across(-along.y, along.x);
    const auto beside = [&](float share, float distance) {
        return a + share * (c - a) + distance * across;
    };
    svg.line(beside(0.62f, 14), beside(0.3f, 14), {.stroke = Ink::blue, .arrow = true});
    svg.line(beside(0.3f, -14), beside(0.62f, -14), {.stroke = Ink::vermillion, .arrow = true});
    const double half_glass = 0.5 * glass_side * double{scene.step} * edge_unit.x;
    svg.circle(view(scene.aim.at(1.0f)), std::max(9.0, half_glass), {.stroke = Ink::ink}, "glass");
    const std::array<std::pair<Point2, const char*>, 4> names{
        {{moved(a, -14, 2), "*a*"},
         {moved(view(scene.b), 14, 14), "*b*"},
         {moved(c, 14, 0), "*c*"},
         {moved(view(scene.d), -14, 2), "*d*"}}};
    for (const auto& [where, name] : names) svg.text(where, name, {.size = 20});
    svg.text({318, 62}, "*a b c* asks: left of *c* → *a*?",
             {.anchor = Anchor::start, .ink = Ink::blue});
    svg.text({318, 92}, "*a c d* asks: left of *a* → *c*?",
             {.anchor = Anchor::start, .ink = Ink::vermillion});
    svg.text({318, 136}, "Exactly:", {.anchor = Anchor::start});
    svg.text({318, 162}, "*E*_{ca} = −*E*_{ac}:", {.anchor = Anchor::start, .size = 20});
    svg.text({318, 192}, "one of the two says yes.", {.anchor = Anchor::start});
    svg.text({318, 218}, "Rounded: see below.", {.anchor = Anchor::start});
}

void draw_glass(Svg& svg, const EdgeScene& scene, std::size_t i,
                const std::array<EdgeVerdicts, 3>& all) {
    const EdgeVerdicts &verdicts = all[i], &exact = all.back();
    Image image(glass_side, glass_side);
    for (int y = 0; y < glass_side; ++y)
        for (int x = 0; x < glass_side; ++x) {
            const auto square = static_cast<std::size_t>(y * glass_side + x);
            const bool is_outside = verdicts[square] == 0 && exact[square] == 0;
            image.at(x, y) = pixel(is_outside ? Ink::faint : verdict_inks[verdicts[square]]);
        }
    const Point2 corner(glass_corner(i));
    const std::string_view name = drawn_test_names[scene.tests[i]];
    const auto twin = std::ranges::find(scene.tests, scene.tests[i]);
    const bool is_first = twin == scene.tests.begin() + static_cast<std::ptrdiff_t>(i);
    svg.picture(corner, {size, size}, image, is_first ? name : std::string_view());
    svg.rect(corner, {size, size}, {.stroke = Ink::quiet});
    svg.text(corner + Vector2(size / 2, 224), name, {.size = 17, .bold = true});
    const int leaks = leaks_of(verdicts, exact);
    std::string says = leaks ? fmt::format("{} leaks", leaks) : "no leak";
    if (scene.marked) {
        says += fmt::format("; ray: {}", verdict_texts[verdicts.of(*scene.marked)]);
        const double half = 0.5 * glass_side;
        svg.rect(moved(corner, glass_square * (half + scene.marked->right) - 2,
                       glass_square * (half - scene.marked->up) - 2),
                 at(glass_square + 4, glass_square + 4));
    }
    svg.text(corner + Vector2(size / 2, 248), says,
             {.ink = leaks ? Ink::vermillion : Ink::ink, .size = 17});
}

template <class Test>
EdgeVerdicts verdicts_of(const EdgeScene& scene) {
    EdgeVerdicts verdicts{};
    constexpr int half = glass_side / 2;
    const Triangle lower = scene.lower(), upper = scene.upper();
    for (int up = half; up > half - glass_side; --up)
        for (int right = -half; right < glass_side - half; ++right) {
            const Ray ray = scene.ray({right, up});
            verdicts.of({right, up}) = (Test::intersect(ray, lower).has_value() ? 1u : 0u) +
                                       (Test::intersect(ray, upper).has_value() ? 2u : 0u);
        }
    return verdicts;
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

Ray EdgeScene::ray(const GlassPlace& place) const {
    const Vector3 offset(static_cast<float>(place.right) * step,
                         static_cast<float>(place.up) * step, 0.0f);
    return {.origin = aim.origin, .direction = aim.direction + offset};
}

int leaks_of(const EdgeVerdicts& verdicts, const EdgeVerdicts& exact) {
    int leaks = 0;
    for (std::size_t i = 0; i < verdicts.size(); ++i) leaks += verdicts[i] == 0 && exact[i] != 0;
    return leaks;
}

std::array<EdgeVerdicts, 3> edge_verdicts(const EdgeScene& scene) {
    std::array<EdgeVerdicts, 3> all;
    for (std::size_t i = 0; i < all.size(); ++i)
        for_each_named(triangle_tests, [&](std::size_t test, const auto& named) {
            if (test == scene.tests[i]) all[i] = verdicts_of<TestOf<decltype(named)>>(scene);
        });
    return all;
}

Ray edge_ray(const Point3& a, const Point3& c, float share, const Vector2& beside) {
    constexpr Point3 eye{3.0f, 2.0f, 5.0f};
    return {.origin = eye, .direction = a + share * (c - a) + Vector3(beside, 0.0f) - eye};
}

float edge_step(const Ray& aim) {
    const auto gap = [](float x) { return std::nextafter(std::abs(x), infinity) - std::abs(x); };
    return std::max(gap(aim.direction.x), gap(aim.direction.y));
}

Svg drawn_edge(const EdgeScene& scene, const std::array<EdgeVerdicts, 3>& verdicts) {
    Svg svg(
        "Two triangles with a common edge, and the rays about it under a magnifying glass, for "
        "three tests",
        640, 566);
    draw_triangles(svg, scene);
    for (std::size_t i = 0; i < scene.tests.size(); ++i) draw_glass(svg, scene, i, verdicts);
    draw_legend(svg);
    return svg;
}

}  // namespace space::ch02
