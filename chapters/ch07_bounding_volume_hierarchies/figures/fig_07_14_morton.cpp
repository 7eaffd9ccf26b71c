// Segments in the order of their middles' Morton codes, and the tree that is cut where the codes'
// highest bits change.

#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace space::ch07 {
namespace {

constexpr double plane_left = 14, plane_scale = 25, plane_height = 13;

Ink level_ink(unsigned depth) {
    constexpr std::array inks{Ink::quiet, Ink::vermillion, Ink::blue};
    return inks[std::min<std::size_t>(depth, inks.size() - 1)];
}

void draw_plane(Svg& svg, const Story& story, const std::vector<std::uint32_t>& order,
                const std::vector<BvhReference<2>>& references) {
    const PlaneView view{.corner = {plane_left, 12}, .scale = plane_scale, .size = plane_height};
    story.tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        if (depth == 0 || depth > 2) return;
        draw_box(svg, view, story.tree.nodes[index].box, depth == 1 ? 6 : 2,
                 {.stroke = level_ink(depth),
                  .fill = depth == 2 ? std::optional(Ink::sky) : std::nullopt,
                  .opacity = 0.25});
    });
    std::vector<Point2> curve;
    for (const std::uint32_t i : order)
        curve.push_back(view(Double2(references[i].box.centroid())));
    svg.polyline(curve, {.stroke = Ink::orange});
    for (const Segment& segment : story.segments)
        draw_segment(svg, view, Double2(segment.a), Double2(segment.b),
                     {.stroke = {}, .fill = Ink::ink});
    for (std::size_t place = 0; place < order.size(); ++place) {
        svg.circle(curve[place], 3.5, {.stroke = Ink::paper, .fill = Ink::vermillion});
        svg.text(moved(curve[place], 7, -6), std::to_string(place),
                 {.anchor = Anchor::start, .size = 17, .halo = true});
    }
}

/// Leaves at the bottom hold the places of the order.
void draw_order_tree(Svg& svg, const Story& story) {
    const std::vector<Double2> layout = layout_of(story.tree);
    double slots = 0.0;
    story.tree.for_each_node(
        [&](std::uint32_t index, unsigned) { slots = std::max(slots, layout[index].x + 0.5); });
    const auto place = [&](std::uint32_t node) {
        return at(plane_left + 640.0 / slots * layout[node].x, 366 + 32 * layout[node].y);
    };
    story.tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        const BvhNode<2>& node = story.tree.nodes[index];
        if (node.is_leaf()) return;
        for (const std::uint32_t child : {node.first, node.first + 1})
            svg.line(place(index), place(child), {.stroke = level_ink(depth + 1)});
    });
    std::size_t next = 0;
    story.tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        if (!story.tree.nodes[index].is_leaf()) {
            svg.circle(place(index), 6, {.stroke = level_ink(depth), .fill = Ink::paper});
            return;
        }
        svg.rect(moved(place(index), -12, -11), at(24, 22),
                 {.stroke = Ink::quiet, .fill = Ink::paper});
        svg.text(moved(place(index), 0, 6), std::to_string(next++), {.size = 17});
    });
}

}  // namespace

Svg fig_07_14(const Options&) {
    const Story story =
        watched_build<MortonBuilder>(scattered_segments(), {.costs = {}, .max_leaf_size = 1});
    const std::vector<BvhReference<2>> references = boxed<2>(story.segments);
    const std::vector<std::uint32_t> order = MortonBuilder::order_of<2>(references).indices;
    Svg svg("Segments in Morton order, the boxes of the tree's first two levels, and the tree", 676,
            390 + 32 * static_cast<double>(story.tree.depth));
    draw_plane(svg, story, order, references);
    draw_order_tree(svg, story);
    return svg;
}

}  // namespace space::ch07
