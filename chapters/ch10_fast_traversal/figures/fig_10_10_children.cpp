// A node with eight children, and a ray: what all lanes say, and which children are visited. The
// segments are walls, seen from above.

#include "chapters/ch10_fast_traversal/collapse.hpp"
#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/figures/walls.hpp"
#include "chapters/ch10_fast_traversal/wide_walk.hpp"
#include "common/accelerator.hpp"
#include "common/program/walk_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace space::ch10 {
namespace {

/// What became of a child of the root.
enum class Fate { not_met, visited, passed_over };

/// What the walk tells about the root's children.
struct RootWatcher {
    const WideTree<8>& tree;
    const Walls<3>& walls;
    const Ray2& ray;
    double nearest = infinity;
    std::array<Fate, 8> fates = {};
    std::array<std::size_t, 8> order = {};  ///< from 1 on, of those met

    void mark(WideChild child, Fate fate) {
        const WideNode<8>& root = tree.nodes[tree.root.index()];
        for (std::size_t i = 0; i < 8; ++i)
            if (root.is_used(i) && root.children[i] == child) fates[i] = fate;
    }
    void observe(const WideVisit<8>& event) {
        mark(WideChild::node(event.node), Fate::visited);
        if (event.node == tree.root.index())
            for (std::size_t i = 0; i < event.size; ++i) order[event.met[i].place] = i + 1;
    }
    void observe(const WideLeafVisit& event) {
        mark(event.leaf, Fate::visited);
        for (std::uint32_t b = 0; b < event.leaf.count(); ++b) {
            const TriangleBlock& block = tree.blocks[event.leaf.first() + b];
            for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane)
                if (block.is_used(lane))
                    nearest =
                        std::min(nearest, distance_along(ray, walls.segments[block.indices[lane]]));
        }
    }
    void observe(const WideSkipped& event) { mark(event.child, Fate::passed_over); }
};

constexpr double children_side = 352;

Ink ink_of(Fate fate) {
    return fate == Fate::visited       ? Ink::green
           : fate == Fate::passed_over ? Ink::orange
                                       : Ink::faint;
}

/// The node's lanes, a row for each: the part of the ray between all near and all far planes, the
/// mask's bit, and the order.
void draw_lanes(Svg& svg, const RootWatcher& watcher, const BvhRay<3>& prepared, double end) {
    const WideNode<8>& root = watcher.tree.nodes[watcher.tree.root.index()];
    constexpr double left = 400, width = 200, top = 52, row = 36;
    const auto on_axis = [&](double t) { return left + width * std::clamp(t / end, 0.0, 1.0); };
    svg.text(at(382, 26), "lane", {.ink = Ink::quiet, .size = 17});
    svg.text(at(left + width / 2 + 10, 26), "enter to leave", {.ink = Ink::quiet, .size = 17});
    svg.text(at(620, 26), "mask", {.ink = Ink::quiet, .size = 17});
    svg.text(at(682, 26), "order", {.ink = Ink::quiet, .size = 17});
    for (std::size_t i = 0; i < 8; ++i) {
        const double y = top + row * static_cast<double>(i);
        svg.text(at(382, y + 6), std::to_string(i), {.size = 18});
        svg.line(at(left, y), at(left + width, y), {.stroke = Ink::faint});
        const auto [enter, leave] = prepared.span_in(root.box(i), infinity);
        const bool is_met = watcher.order[i] > 0;
        if (is_met)
            svg.rect(at(on_axis(enter), y - 7), at(on_axis(leave) - on_axis(enter), 14),
                     {.stroke = {}, .fill = ink_of(watcher.fates[i])});
        svg.text(at(620, y + 6), is_met ? "1" : "0",
                 {.ink = is_met ? Ink::ink : Ink::quiet, .size = 18});
        if (is_met) svg.text(at(682, y + 6), std::to_string(watcher.order[i]), {.size = 18});
    }
    const double x = on_axis(watcher.nearest);
    svg.line(at(x, top - 14), at(x, top + 7 * row + 14), {.stroke = Ink::vermillion});
    svg.text(at(x, top + 7 * row + 34), "hit", {.ink = Ink::vermillion, .size = 17});
}

void draw_scene(Svg& svg, const RootWatcher& watcher, const PlaneView& view, double end) {
    const WideNode<8>& root = watcher.tree.nodes[watcher.tree.root.index()];
    svg.rect(view({0, heinonen_size}), at(children_side, children_side), {.stroke = Ink::faint});
    for (std::size_t i = 0; i < 8; ++i) {
        if (!root.is_used(i)) continue;
        const Ink ink = ink_of(watcher.fates[i]);
        const bool is_met = watcher.order[i] > 0;
        draw_box_on(svg, view, from_above(root.box(i)), 0.0,
                    {.stroke = is_met ? ink : Ink::quiet,
                     .fill = is_met ? std::optional(ink) : std::nullopt,
                     .opacity = 0.2});
    }
    for (const Segment& segment : watcher.walls.segments)
        draw_segment(svg, view, Double2(segment.a), Double2(segment.b),
                     {.stroke = {}, .fill = Ink::ink});
    const auto on_ray = [&](double t) {
        return view(Double2(watcher.ray.origin) + t * Double2(watcher.ray.direction));
    };
    svg.line(on_ray(0.0), on_ray(end), {.stroke = Ink::blue, .arrow = true});
    svg.circle(on_ray(0.0), 5, {.stroke = {}, .fill = Ink::blue});
    svg.circle(on_ray(watcher.nearest), 8, {.stroke = Ink::vermillion});
    for (std::size_t i = 0; i < 8; ++i)
        if (root.is_used(i))
            svg.text(moved(view(Double2(root.box(i).min.x, root.box(i).max.y)), 10, 17),
                     std::to_string(i), {.size = 18, .halo = true});
}

}  // namespace

Svg fig_10_10(const Options&) {
    const auto walls = walls_on<3>(clustered_segments(1584, 8, 2));
    const WideTree<8> tree = collapsed<8>(walls.binary, walls.polygons, {.max_leaf = 4});
    const Ray2 ray{.origin = {0.5f, 5.5f}, .direction = {1.0f, 0.25f}};
    const BvhRay<3> prepared(
        {{ray.origin.x, ray.origin.y, 1.0f}, {ray.direction.x, ray.direction.y, 0.0f}},
        BoxMargins::none);
    RootWatcher watcher{.tree = tree, .walls = walls, .ray = ray};
    NoCounts none;
    walk_wide(
        tree, prepared, none, [&](const TriangleBlock&) { return watcher.nearest; }, watcher);
    Svg svg("A node with eight children: which of them a ray meets, and which it visits", 708, 368);
    const PlaneView view{
        .corner = {8, 8}, .scale = children_side / heinonen_size, .size = heinonen_size};
    constexpr double end = 15.0;
    draw_scene(svg, watcher, view, end);
    draw_lanes(svg, watcher, prepared, end);
    return svg;
}

}  // namespace space::ch10
