#include "chapters/ch02_intersection_tests/figures.hpp"
#include "chapters/ch02_intersection_tests/figures/bar.hpp"
#include "chapters/ch02_intersection_tests/measured/exact_deciders.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "chapters/ch02_intersection_tests/shape_tests.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace space::ch02 {
namespace {

/// How many of the rays in the planes of faces each test misses.
void draw_misses(Svg& svg) {
    svg.text({320, 478}, "0 · ∞ is not a number: rays in planes of faces",
             {.size = 19, .bold = true});
    const std::vector<RayAndBox> lattice = lattice_boxes();
    std::array<int, box_test_count> missed{};
    int hits = 0;
    for (const RayAndBox& pair : lattice) {
        if (!exactly_hits(pair.ray, pair.box)) continue;
        ++hits;
        for_each_named(box_tests, [&](std::size_t i, const auto& named) {
            missed[i] += !TestOf<decltype(named)>::intersect(pair.ray, pair.box);
        });
    }
    svg.text({320, 504},
             fmt::format("missed of {} hits", with_commas(static_cast<std::uint64_t>(hits))),
             {.ink = Ink::quiet});
    double top = 522;
    for_each_named(box_tests, [&](std::size_t i, const auto& named) {
        if (named.name == "as printed") return;
        svg.text(at(150, top + 17), named.name, {.anchor = Anchor::end});
        bar(svg, 164, 164 + 400.0 * missed[i] / hits + 2, top, 22,
            missed[i] ? Ink::vermillion : Ink::green);
        svg.text(at(164 + 400.0 * missed[i] / hits + 12, top + 17),
                 missed[i] ? with_commas(static_cast<std::uint64_t>(missed[i])) : "none",
                 {.anchor = Anchor::start});
        top += 36;
    });
}

}  // namespace

Svg fig_02_06(const Options&) {
    Svg svg(
        "A ray in two slabs, the intervals of t in each, and their common part; below, what "
        "five tests miss",
        640, 712);
    const Aabb box{{2.2f, 1.2f, -1.0f}, {4.4f, 2.6f, 1.0f}};
    const Ray ray{.origin = {0.4f, 0.1f, 0.0f}, .direction = {1.0f, 0.5f, 0.0f}};
    constexpr double scale = 100, floor = 310;
    const auto view = [](double x, double y) { return at(scale * x, floor - scale * y); };
    const auto on_ray = [&](double t) {
        return view(ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y);
    };
    struct Slab {
        double near, far;
    };
    const auto slab = [&](int axis) {
        return Slab{(double{box.min[axis]} - ray.origin[axis]) / ray.direction[axis],
                    (double{box.max[axis]} - ray.origin[axis]) / ray.direction[axis]};
    };
    const Slab x = slab(0), y = slab(1);
    const Interval both = SlabSafe::intersect(ray, box).value();

    svg.rect(view(box.min.x, 3.1), at(scale * (box.max.x - box.min.x), floor + 10),
             {.stroke = {}, .fill = Ink::sky, .opacity = 0.35}, "x-slab");
    svg.rect(view(0, box.max.y), at(640, scale * (box.max.y - box.min.y)),
             {.stroke = {}, .fill = Ink::orange, .opacity = 0.3}, "y-slab");
    constexpr double axis = 372;  // of t: d.x is 1, so that each mark stands below its point
    const std::array<std::pair<double, double>, 4> marks{
        {{x.near, axis}, {x.far, axis}, {y.near, axis + 30}, {y.far, axis + 30}}};
    for (const auto& [t, down] : marks)
        svg.line(moved(on_ray(t), 0, 6), at(on_ray(t).x, down), {.stroke = Ink::faint});
    svg.rect(view(box.min.x, box.max.y),
             at(scale * (box.max.x - box.min.x), scale * (box.max.y - box.min.y)), {}, "box");
    svg.line(on_ray(0), on_ray(5.65), {.stroke = Ink::vermillion, .arrow = true});
    svg.circle(on_ray(0), 5, {.stroke = {}, .fill = Ink::vermillion});
    svg.text(moved(on_ray(0), 0, -14), "*O*", {.size = 20});
    svg.text(moved(view(box.min.x, 3.1), 8, 22), "*x* slab",
             {.anchor = Anchor::start, .ink = Ink::blue});
    svg.text(moved(view(0, box.max.y), 8, 24), "*y* slab", {.anchor = Anchor::start});

    for (const auto& [t, down] : marks) svg.circle(on_ray(t), 5, {.fill = Ink::paper});
    const auto interval = [&](double y_of, double near, double far, Ink ink,
                              const std::string& label) {
        bar(svg, on_ray(near).x, on_ray(far).x, y_of, 16, ink);
        svg.text(at(on_ray(near).x - 10, y_of + 15), label, {.anchor = Anchor::end});
        svg.text(at(on_ray(far).x + 10, y_of + 15), fmt::format("{:.1f} .. {:.1f}", near, far),
                 {.anchor = Anchor::start});
    };
    interval(axis - 10, x.near, x.far, Ink::sky, "in the *x* slab");
    interval(axis + 20, y.near, y.far, Ink::orange, "in the *y* slab");
    interval(axis + 50, both.enter, both.leave, Ink::green, "in the box");

    draw_misses(svg);
    return svg;
}

}  // namespace space::ch02
