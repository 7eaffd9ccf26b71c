// Two walls that a ray hits at the same t, in boxes that it enters at different ones: what becomes
// of the second where the walk leaves out what begins *at* the hit.

#include "chapters/ch07_bounding_volume_hierarchies/bvh_ray.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"
#include "common/program/walk_drawing.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace space::ch07 {
namespace {

/// 0 and 1 are two parts of one wall, and meet where the ray comes. 2 is in the box of 1.
const std::array<Segment, 3> walls{{{{8.0f, 4.0f}, {8.0f, 7.25f}},
                                    {{8.0f, 0.75f}, {8.0f, 4.0f}},
                                    {{2.75f, 0.75f}, {5.25f, 1.75f}}}};
const Ray2 ray{.origin = {0.5f, 2.125f}, .direction = {1.0f, 0.25f}};

struct Leaf {
    std::vector<std::uint32_t> names;
    Aabb2 box = {};
    double enter = 0.0;
};
std::vector<Leaf> leaves() {
    std::vector<Leaf> both{{.names = {1, 2}}, {.names = {0}}};
    for (Leaf& leaf : both) {
        for (const std::uint32_t i : leaf.names) {
            leaf.box.extend(walls[i].a);
            leaf.box.extend(walls[i].b);
        }
        leaf.enter = double{BvhRay<2>(ray, BoxMargins::none).span_in(leaf.box, infinity).enter};
    }
    return both;
}

/// The walk of two leaves, near to far, of equal t the lower number.
struct Walk {
    std::vector<bool> visited = {};
    std::optional<std::uint32_t> answer = {};
    double t = infinity;

    Walk(const std::vector<Leaf>& in_order, bool strict) {
        for (const Leaf& leaf : in_order) {
            visited.push_back(strict ? !(leaf.enter > t) : !(leaf.enter >= t));
            if (!visited.back()) continue;
            for (const std::uint32_t i : leaf.names) {
                const double own = distance_along(ray, walls[i]);
                if (own < t || (own == t && answer && i < *answer)) {
                    t = own;
                    answer = i;
                }
            }
        }
    }
};

void draw_panel(Svg& svg, double left, const char* rule, bool strict) {
    const PlaneView view{.corner = {left, 44}, .scale = 33, .size = 8};
    const std::vector<Leaf> in_order = leaves();
    const Walk walk(in_order, strict);
    svg.text(at(left + 160, 26), rule, {.bold = true});
    for (std::size_t i = 0; i < in_order.size(); ++i) {
        const bool seen = walk.visited[i];
        draw_box(svg, view, in_order[i].box, 7,
                 {.stroke = seen ? Ink::blue : Ink::quiet,
                  .fill = seen ? std::optional(Ink::sky) : std::nullopt,
                  .opacity = 0.3,
                  .dashed = !seen});
        const Point2 corner = view(
            Double2(i == 0 ? in_order[i].box.min.x : in_order[i].box.max.x, in_order[i].box.max.y));
        svg.text(i == 0 ? moved(corner, 0, -14) : moved(corner, -18, 30),
                 fmt::format("*t* ≥ {}{}", written_t(in_order[i].enter), seen ? "" : ", left out"),
                 {.anchor = i == 0 ? Anchor::start : Anchor::end,
                  .ink = seen ? Ink::blue : Ink::quiet,
                  .size = 18,
                  .halo = true});
    }
    for (std::uint32_t i = 0; i < walls.size(); ++i) {
        draw_segment(svg, view, Double2(walls[i].a), Double2(walls[i].b),
                     {.stroke = {}, .fill = walk.answer == i ? Ink::vermillion : Ink::ink});
        const Double2 middle = 0.5 * (Double2(walls[i].a) + Double2(walls[i].b));
        svg.text(moved(view(middle), i == 2 ? 0 : 22, i == 2 ? -14 : 8), std::to_string(i),
                 {.ink = walk.answer == i ? Ink::vermillion : Ink::ink, .size = 24, .bold = true});
    }
    const Double2 origin(ray.origin);
    svg.line(view(origin), view(origin + walk.t * Double2(ray.direction)),
             {.stroke = Ink::green, .arrow = true});
    svg.circle(view(origin), 5, {.stroke = {}, .fill = Ink::green});
    svg.circle(view(origin + walk.t * Double2(ray.direction)), 9, {.stroke = Ink::vermillion});
    svg.text(at(left + 160, 336),
             fmt::format("hit: {}, at *t* = {}", *walk.answer, written_t(walk.t)), {.size = 18});
}

}  // namespace

Svg fig_07_05(const Options&) {
    Svg svg(
        "A ray hits two walls at the same t. Left out is what begins at the hit, and a tie is "
        "lost; left out is what begins beyond it, and it is not",
        676, 352);
    draw_panel(svg, 4, "*enter* ≥ *t*: left out", false);
    draw_panel(svg, 348, "*enter* > *t*: left out", true);
    return svg;
}

}  // namespace space::ch07
