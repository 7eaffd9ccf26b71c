#include "chapters/ch09_instancing_and_motion/figures/drawn_rotations.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "common/program/tree_layout.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace space::ch09 {
namespace {

/// The tree at one moment of a refit.
struct Moment {
    BvhNodes<2> tree;
    std::span<const Segment> segments;
    std::uint32_t stands;  ///< boxes of this place and of those behind it are made
    std::optional<std::uint32_t> in_hand;
    std::string tells;
};

/// Inner nodes' numbers, by where their pairs stand: these go with a node that is moved.
using Names = std::map<std::uint32_t, std::string>;
Names names_of(const BvhNodes<2>& tree) {
    Names names;
    tree.for_each_node([&](std::uint32_t i, unsigned) {
        const BvhNode<2>& node = tree.nodes[i];
        if (!node.is_leaf()) names[node.first] = std::to_string(names.size() + 1);
    });
    return names;
}
std::string name_of(const Names& names, const BvhNodes<2>& tree, std::uint32_t place) {
    const BvhNode<2>& node = tree.nodes[place];
    if (!node.is_leaf()) return names.at(node.first);
    return std::string(1, static_cast<char>('A' + tree.references[node.first]));
}

std::vector<Moment> moments_of(const Names& names, BvhNodes<2> tree, std::span<const Segment> rest,
                               std::span<const Segment> moved) {
    const auto end = static_cast<std::uint32_t>(tree.nodes.size());
    std::vector<Moment> moments{
        {tree, rest, 0, {}, "At rest: each box is as small as it can be."},
        {tree, moved, end, {}, "The segments have moved, and the boxes have not."}};
    const auto name = [&](std::uint32_t place) { return name_of(names, tree, place); };
    bool has_turned = false;
    refit_upwards(
        tree,
        [&](const BvhNode<2>& leaf) {
            return box_if_finite<2>(moved[tree.references[leaf.first]]);
        },
        [&](std::uint32_t i) {
            const std::uint32_t first = tree.nodes[i].first;
            std::string tells = fmt::format("Node {}: the box around those of {} and {}.", name(i),
                                            name(first), name(first + 1));
            moments.push_back({tree, moved, i, i, tells});
            const BvhRotation best = best_rotation(tree, i);
            if (!(best.saved > 0.0)) return;
            tells = fmt::format(
                "Node {}: {} and {} change places. That makes boxes of its children smaller, by "
                "{:.1f} "
                "of half their boundaries.",
                name(i), name(best.one), name(best.other), best.saved);
            has_turned = rotate_below(tree, i);
            moments.push_back({tree, moved, i, i, tells});
        });
    moments.push_back({tree,
                       moved,
                       0,
                       {},
                       has_turned ? "All boxes stand, and the tree has another shape."
                                  : "All boxes stand. No two subtrees have changed places."});
    return moments;
}

void draw_boxes(Svg& svg, const Moment& moment) {
    const PlaneView& view = rotations_view;
    moment.tree.for_each_node([&](std::uint32_t i, unsigned depth) {
        const BvhNode<2>& node = moment.tree.nodes[i];
        if (node.is_leaf()) return;
        const double apart = 17.0 - 3.5 * depth;  // of boxes that share a side
        const Point2 low = view(Double2(node.box.min)), high = view(Double2(node.box.max));
        const bool is_old = i < moment.stands, is_in_hand = i == moment.in_hand;
        svg.rect(moved(at(low.x, high.y), -apart, -apart),
                 at(high.x - low.x + 2 * apart, low.y - high.y + 2 * apart),
                 {.stroke = is_in_hand ? Ink::green
                            : is_old   ? Ink::quiet
                                       : Ink::blue,
                  .fill = is_in_hand ? std::optional(Ink::green) : std::nullopt,
                  .opacity = 0.15,
                  .dashed = is_old});
    });
    for (std::size_t i = 0; i < moment.segments.size(); ++i) {
        const Double2 a(moment.segments[i].a), b(moment.segments[i].b);
        draw_segment(svg, view, a, b, {.stroke = {}, .fill = Ink::ink});
        // Beside the segment's middle, above it; the letter's own middle is 7 above its line.
        const Double2 along = glm::normalize(b - a);
        const double side = along.x < 0.0 ? -17.0 : 17.0;
        svg.text(moved(view(0.5 * (a + b)), -side * along.y, 7 - side * along.x),
                 fmt::format("*{}*", static_cast<char>('A' + i)), {.size = 20, .halo = true});
    }
}

void draw_tree(Svg& svg, const Names& names, const Moment& moment) {
    const BvhNodes<2>& tree = moment.tree;
    std::vector<std::uint32_t> places;
    std::vector<std::size_t> number(tree.nodes.size());
    tree.for_each_node([&](std::uint32_t i, unsigned) {
        number[i] = places.size();
        places.push_back(i);
    });
    std::vector<std::vector<std::size_t>> children(places.size());
    for (const std::uint32_t i : places)
        if (!tree.nodes[i].is_leaf())
            children[number[i]] = {number[tree.nodes[i].first], number[tree.nodes[i].first + 1]};
    const std::vector<Double2> layout = tree_layout(children);
    const auto place = [&](std::size_t k) {
        return at(400 + 40 * layout[k].x, 40 + 66 * layout[k].y);
    };
    for (std::size_t k = 0; k < places.size(); ++k)
        for (const std::size_t child : children[k])
            svg.line(place(k), place(child), {.stroke = Ink::quiet});
    for (std::size_t k = 0; k < places.size(); ++k) {
        const bool is_leaf = children[k].empty(), is_old = places[k] < moment.stands;
        const Ink ink = is_leaf                       ? Ink::quiet
                        : places[k] == moment.in_hand ? Ink::green
                        : is_old                      ? Ink::quiet
                                                      : Ink::blue;
        const Style style{.stroke = ink, .fill = Ink::paper, .dashed = is_old && !is_leaf};
        if (is_leaf)
            svg.rect(moved(place(k), -15, -15), at(30, 30), style);
        else
            svg.circle(place(k), 17, style);
        const std::string name = name_of(names, tree, places[k]);
        svg.text(moved(place(k), 0, 7), is_leaf ? fmt::format("*{}*", name) : name, {.size = 19});
    }
}

}  // namespace

std::vector<Segment> drifted(std::span<const Segment> rest, std::span<const Double2> ways) {
    std::vector<Segment> segments(rest.begin(), rest.end());
    for (std::size_t i = 0; i < segments.size(); ++i)
        for (Point2* end : {&segments[i].a, &segments[i].b}) *end += Vector2(ways[i]);
    return segments;
}

Svg drawn_rotations(std::span<const Segment> rest, std::span<const Segment> moved) {
    const BvhNodes<2> tree =
        BinnedBuilder::build<2>(rest, {.costs = {1.0, 1.0}, .max_leaf_size = 1});
    const Names names = names_of(tree);
    const std::vector<Moment> moments = moments_of(names, tree, rest, moved);
    Svg svg("Seven segments have moved: their tree is refitted and repaired, node by node", 690,
            350);
    for (std::size_t k = 0; k < moments.size(); ++k) {
        svg.begin_step_alone(k, moments.size(), moments[k].tells);
        draw_boxes(svg, moments[k]);
        draw_tree(svg, names, moments[k]);
        svg.end_group();
    }
    return svg;
}

}  // namespace space::ch09
