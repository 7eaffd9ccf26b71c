// A node's planes in eight bits: the children's boxes as they are and as they come back.

#include "chapters/ch10_fast_traversal/collapse.hpp"
#include "chapters/ch10_fast_traversal/compressed_node.hpp"
#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/figures/walls.hpp"

#include <algorithm>
#include <cstddef>

namespace space::ch10 {
namespace {

constexpr double panel = 336;

/// All children, and what is shown larger.
void draw_node_boxes(Svg& svg, const WideNode<8>& node, const Aabb2& shown) {
    const PlaneView view{.corner = {8, 8}, .scale = panel / heinonen_size, .size = heinonen_size};
    svg.rect(view({0, heinonen_size}), at(panel, panel), {.stroke = Ink::faint});
    for (std::size_t i = 0; i < 8; ++i)
        if (node.is_used(i))
            draw_box_on(svg, view, from_above(node.box(i)), 0.0,
                        {.stroke = Ink::blue, .fill = Ink::blue, .opacity = 0.15});
    draw_box_on(svg, view, shown, 0.0, {.stroke = Ink::quiet, .dashed = true});
}

/// A part of the plane with the grid's lines, and a child's two boxes.
void draw_grid(Svg& svg, const CompressedNode& small, const Aabb2& exact, const Aabb2& back,
               const Aabb2& shown) {
    const double side = double{shown.max.x} - double{shown.min.x}, scale = panel / side;
    const auto on_paper = [&](double x, double y) {
        return at(362 + scale * (x - double{shown.min.x}), 8 + scale * (double{shown.max.y} - y));
    };
    for (std::size_t axis = 0; axis < 2; ++axis)
        for (int q = 0; q < 256; ++q) {
            const double at_plane{small.plane(axis, q)};
            const int i = static_cast<int>(axis);
            if (at_plane < double{shown.min[i]} || at_plane > double{shown.max[i]}) continue;
            if (axis == 0)
                svg.line(on_paper(at_plane, shown.min.y), on_paper(at_plane, shown.max.y),
                         {.stroke = Ink::faint});
            else
                svg.line(on_paper(shown.min.x, at_plane), on_paper(shown.max.x, at_plane),
                         {.stroke = Ink::faint});
        }
    const auto draw = [&](const Aabb2& box, const Style& style) {
        const Point2 corner = on_paper(box.min.x, box.max.y);
        svg.rect(corner, on_paper(box.max.x, box.min.y) - corner, style);
    };
    draw(back, {.stroke = Ink::green, .fill = Ink::green, .opacity = 0.15});
    draw(exact, {.stroke = Ink::blue, .fill = Ink::blue, .opacity = 0.15});
    svg.rect(at(362, 8), at(panel, panel), {.stroke = Ink::quiet});
}

}  // namespace

Svg fig_10_12(const Options&) {
    constexpr std::size_t child = 2;
    const auto walls = walls_on<3>(clustered_segments(1584, 8, 2));
    const WideTree<8> tree = collapsed<8>(walls.binary, walls.polygons, {.max_leaf = 4});
    const WideNode<8>& node = tree.nodes[tree.root.index()];
    const CompressedNode small = compressed(node);
    const Aabb2 exact = from_above(node.box(child)), back = from_above(small.box(child));
    const Point2 middle = exact.centroid();
    const float half = 0.7f * std::max(exact.extent().x, exact.extent().y);
    const Aabb2 shown{middle - Vector2(half), middle + Vector2(half)};
    Svg svg("A node's children, and the box of one of them larger, rounded outwards to the grid",
            706, 352);
    draw_node_boxes(svg, node, shown);
    draw_grid(svg, small, exact, back, shown);
    return svg;
}

}  // namespace space::ch10
