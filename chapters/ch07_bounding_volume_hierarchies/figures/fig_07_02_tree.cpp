// The segments A to G in nested boxes, and the tree that these are.

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace space::ch07 {
namespace {

/// By depth from the root.
Ink ink_of(unsigned depth) {
    constexpr std::array inks{Ink::ink, Ink::blue, Ink::vermillion, Ink::green, Ink::purple};
    return inks[std::min<std::size_t>(depth, inks.size() - 1)];
}

/// Where a node's number stands, in its box and in none of those below: by number.
constexpr std::array<Double2, 7> number_places{
    Double2(0.0),        Double2(8.32, 15.4), Double2(1.9, 7.2), Double2(6.2, 13.2),
    Double2(8.95, 5.98), Double2(11.3, 1.35), Double2(9.3, 13.4)};

/// How high the tree is above a node's lowest leaf: so much apart are boxes that share a side.
std::vector<double> heights(const BvhNodes<2>& tree) {
    std::vector<double> of(tree.nodes.size(), 0.0);
    for (std::size_t i = tree.nodes.size(); i-- > 0;)
        if (const BvhNode<2>& node = tree.nodes[i]; i != 1 && !node.is_leaf())
            of[i] = 1.0 + std::max(of[node.first], of[node.first + 1]);
    return of;
}

void draw_plane(Svg& svg, const Story& story) {
    const PlaneView view{.corner = {10, 14}, .scale = 21, .size = heinonen_size};
    const std::vector<double> height = heights(story.tree);
    story.tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        const BvhNode<2>& node = story.tree.nodes[index];
        draw_box(svg, view, node.box, 3.5 + 4.5 * height[index],
                 {.stroke = node.is_leaf() ? Ink::quiet : ink_of(depth)});
    });
    for (const NamedSegment& segment : story.named) {
        draw_segment(svg, view, segment.from, segment.to, {.stroke = {}, .fill = Ink::ink});
        svg.text(heinonen_name_place(view, segment), drawn_name(segment.name),
                 {.size = 24, .halo = true});
    }
    const std::vector<std::uint32_t> numbers = inner_numbers(story.tree);
    story.tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        const BvhNode<2>& node = story.tree.nodes[index];
        if (node.is_leaf()) return;
        svg.text(view(number_places.at(numbers[index])), std::to_string(numbers[index]),
                 {.anchor = Anchor::start,
                  .ink = ink_of(depth),
                  .size = 18,
                  .bold = true,
                  .halo = true});
    });
}

void draw_tree(Svg& svg, const Story& story) {
    const std::vector<Double2> layout = layout_of(story.tree);
    const auto place = [&](std::uint32_t node) {
        return at(370 + 43 * layout[node].x, 42 + 84 * layout[node].y);
    };
    story.tree.for_each_node([&](std::uint32_t index, unsigned) {
        const BvhNode<2>& node = story.tree.nodes[index];
        if (node.is_leaf()) return;
        for (const std::uint32_t child : {node.first, node.first + 1})
            svg.line(place(index), place(child), {.stroke = Ink::quiet});
    });
    story.tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        const bool leaf = story.tree.nodes[index].is_leaf();
        const Style style{.stroke = leaf ? Ink::quiet : ink_of(depth), .fill = Ink::paper};
        if (leaf)
            svg.rect(moved(place(index), -17, -17), at(34, 34), style);
        else
            svg.circle(place(index), 19, style);
        svg.text(moved(place(index), 0, 8), drawn_node_name(story, index),
                 {.ink = leaf ? Ink::ink : ink_of(depth), .size = 22});
    });
}

}  // namespace

Svg fig_07_02(const Options&) {
    const Story story = watched_build<BinnedBuilder>(heinonen_segments(),
                                                     {.costs = {1.0, 1.0}, .max_leaf_size = 1});
    Svg svg("The segments A to G in nested boxes, and the tree of these boxes", 676, 362);
    draw_plane(svg, story);
    draw_tree(svg, story);
    return svg;
}

}  // namespace space::ch07
