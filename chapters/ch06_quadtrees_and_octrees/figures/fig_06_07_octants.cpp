// Eight octants in the order of a ray, for rays of two directions.

#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch06 {
namespace {

/// A cell that is cut once, with no empty child.
OrthtreeNodes<3> cut_once() {
    OrthtreeNodes<3> tree;
    tree.bounds.extend(Point3(0.0f));
    tree.bounds.extend(Point3(1.0f));
    tree.nodes.resize(1 + orthants<3>);
    tree.nodes[0].children = 1;
    tree.nodes[0].mask = 255;
    return tree;
}

/// The children that the ray comes to, in order.
std::vector<std::uint32_t> met(const Ray& ray) {
    struct Watcher {
        std::vector<std::uint32_t> children = {};
        void observe(const OrthtreeVisit<3>& at) {
            if (at.node > 0) children.push_back(at.node - 1);
        }
    } watcher;
    NoCounts none;
    walk_orthtree(
        cut_once(), OctreeConfig::Walk::parametric, ray, none,
        [](std::uint32_t) { return double{infinity}; }, watcher);
    return watcher.children;
}

/// A cube as seen from the front, a little from the right and from above; z comes towards the eye.
struct CubeView {
    Point2 origin;
    Point2 operator()(const Double3& p) const {
        return moved(origin, 190 * p.x - 92 * p.z, -190 * p.y + 62 * p.z);
    }
};

std::string bits(std::uint32_t k) {
    return fmt::format("{:03b}", k);
}

Double3 centre_of(std::uint32_t k) {
    return 0.25 + 0.5 * Double3(k & 1u, k >> 1 & 1u, k >> 2 & 1u);
}

void draw_cube(Svg& svg, const CubeView& view) {
    for (std::uint32_t from = 0; from < 8; ++from)
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t to = from | 1u << axis;
            if (to == from) continue;
            const Double3 a(from & 1u, from >> 1 & 1u, from >> 2 & 1u),
                b(to & 1u, to >> 1 & 1u, to >> 2 & 1u);
            svg.line(view(a), view(b), {.stroke = Ink::faint});
        }
}

/// An arrow from each octant to those that the ray can go to next.
void draw_octants(Svg& svg, const CubeView& view, std::uint32_t flip,
                  const std::vector<std::uint32_t>& visited) {
    const auto is_visited = [&](std::uint32_t k) {
        return std::ranges::find(visited, k) != visited.end();
    };
    for (std::uint32_t from = 0; from < 8; ++from)
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t to = from | 1u << axis;
            if (to == from) continue;
            const Point2 a = view(centre_of(from ^ flip)), b = view(centre_of(to ^ flip));
            const Vector2 way = 17.0f * glm::normalize(b - a);
            const bool on_way = is_visited(from ^ flip) && is_visited(to ^ flip);
            svg.line(a + way, b - way, {.stroke = on_way ? Ink::blue : Ink::quiet, .arrow = true});
        }
    for (std::uint32_t k = 0; k < 8; ++k) {
        const Point2 c = view(centre_of(k ^ flip));
        const bool on_way = is_visited(k ^ flip);
        svg.circle(c, 15, {.stroke = on_way ? Ink::blue : Ink::quiet, .fill = Ink::paper});
        if (on_way) svg.circle(c, 15, {.stroke = {}, .fill = Ink::sky, .opacity = 0.45});
        svg.text(moved(c, 0, 7), std::to_string(k), {.size = 20, .bold = on_way});
    }
}

void draw_order(Svg& svg, double left, double top, std::uint32_t flip,
                const std::vector<std::uint32_t>& visited) {
    svg.text(at(left, top), "*k*", {.anchor = Anchor::start});
    svg.text(at(left, top + 28), "child", {.anchor = Anchor::start});
    for (std::uint32_t k = 0; k < 8; ++k) {
        const double x = left + 70 + 33.5 * k;
        const bool on_way = std::ranges::find(visited, k ^ flip) != visited.end();
        if (on_way)
            svg.rect(at(x - 16, top - 18), at(32, 54),
                     {.stroke = {}, .fill = Ink::sky, .opacity = 0.45});
        svg.text(at(x, top), std::to_string(k), {.bold = on_way});
        svg.text(at(x, top + 28), bits(k ^ flip), {.size = 16});
    }
}

void draw_panel(Svg& svg, double left, const Ray& ray) {
    const CubeView view{at(left + 108, 244)};
    const std::uint32_t flip = OrthtreeRay<3>(ray).flip;
    const std::vector<std::uint32_t> visited = met(ray);
    const auto sign = [&](int axis) { return ray.direction[axis] < 0 ? "−" : "+"; };
    svg.text(at(left + 160, 24),
             fmt::format("signs {} {} {}, flip {}", sign(0), sign(1), sign(2), bits(flip)),
             {.bold = true});
    draw_cube(svg, view);
    draw_octants(svg, view, flip, visited);
    draw_order(svg, left, 352, flip, visited);
}

void draw_axes(Svg& svg, const CubeView& view) {
    const Point2 o = view(Double3(0.0));
    const auto axis = [&](const Double3& to, const char* name, double x, double y) {
        const Point2 end = view(to);
        svg.line(o, end, {.stroke = Ink::ink, .arrow = true});
        svg.text(moved(end, x, y), name);
    };
    axis({0.16, 0, 0}, "*x*", 9, 6);
    axis({0, 0.22, 0}, "*y*", 0, -8);
    axis({0, 0, 0.3}, "*z*", -10, 10);
}

}  // namespace

Svg fig_06_07(const Options&) {
    Svg svg("The eight octants of a cube, numbered in the order of a ray, for two directions", 680,
            396);
    draw_panel(svg, 8, {.origin = {-0.35f, 0.03f, -0.35f}, .direction = {1.0f, 0.36f, 0.75f}});
    draw_panel(svg, 352, {.origin = {1.4f, 0.1f, 1.2f}, .direction = {-1.0f, 0.6f, -0.8f}});
    draw_axes(svg, CubeView{at(322, 296)});
    return svg;
}

}  // namespace space::ch06
