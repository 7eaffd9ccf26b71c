#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"

#include "common/program/tree_layout.hpp"

#include <algorithm>

namespace space::ch07 {

std::size_t Story::turn_of(std::uint32_t node) const {
    return static_cast<std::size_t>(std::ranges::find(turns, node, &Turn::node) - turns.begin());
}

Story story_of(std::span<const Segment> segments) {
    Story story{.segments = {segments.begin(), segments.end()}, .named = {}};
    for (const Segment& segment : segments)
        story.named.push_back({std::string(1, static_cast<char>('A' + story.named.size() % 26)),
                               Double2(segment.a), Double2(segment.b)});
    return story;
}

ConvexCell corners_of(const Aabb2& box) {
    const Double2 low(box.min), high(box.max);
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

std::vector<Double2> sides_of(const Aabb2& box) {
    const ConvexCell corners = corners_of(box);
    std::vector<Double2> ends;
    for (std::size_t i = 0; i < corners.size(); ++i)
        ends.insert(ends.end(), {corners[i], corners[(i + 1) % corners.size()]});
    return ends;
}

void draw_box(Svg& svg, const PlaneView& view, const Aabb2& box, double larger,
              const Style& style) {
    const Double2 by(larger / view.scale);
    const Point2 corner = view(Double2(box.min.x, box.max.y) + Double2(-by.x, by.y)),
                 opposite = view(Double2(box.max.x, box.min.y) + Double2(by.x, -by.y));
    svg.rect(corner, opposite - corner, style);
}

std::string plain_set(const Story& story, std::span<const BvhReference<2>> set) {
    std::string names;
    for (const BvhReference<2>& reference : set) names += story.named[reference.polygon].name;
    std::ranges::sort(names);
    std::string text = "{";
    for (const char name : names) text += (text.size() > 1 ? ", " : "") + std::string(1, name);
    return text + "}";
}

std::vector<Double2> layout_of(const BvhNodes<2>& tree) {
    std::vector<std::vector<std::size_t>> children(tree.nodes.size());
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        const BvhNode<2>& node = tree.nodes[index];
        if (!node.is_leaf()) children[index] = {node.first, node.first + 1u};
    });
    return tree_layout(children);
}

std::vector<std::uint32_t> inner_numbers(const BvhNodes<2>& tree) {
    std::vector<std::uint32_t> numbers(tree.nodes.size());
    std::uint32_t next = 1;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        if (!tree.nodes[index].is_leaf()) numbers[index] = next++;
    });
    return numbers;
}

std::string plain_node_name(const Story& story, std::uint32_t node) {
    std::string names;
    for (const std::uint32_t i : story.tree.own(node)) names += story.named[i].name;
    return names.empty() ? std::to_string(inner_numbers(story.tree)[node]) : names;
}

std::string drawn_node_name(const Story& story, std::uint32_t node) {
    const std::string name = plain_node_name(story, node);
    return story.tree.nodes[node].is_leaf() ? "*" + name + "*" : name;
}

}  // namespace space::ch07
