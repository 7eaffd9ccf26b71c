#include "chapters/ch09_instancing_and_motion/figures/drawn_refits.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_walk.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "common/program/walk_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space::ch09 {
namespace {

BvhNodes<2> tree_around(std::span<const Segment> walkers) {
    return BinnedBuilder::build<2>(walkers, {.costs = {1.0, 1.0}, .max_leaf_size = 1});
}

BvhNodes<2> with_new_boxes(BvhNodes<2> tree, std::span<const Segment> moved) {
    refit<2>(tree, moved);
    return tree;
}

BvhNodes<2> with_rotated_nodes(BvhNodes<2> tree, std::span<const Segment> moved) {
    refit_upwards(
        tree,
        [&](const BvhNode<2>& leaf) {
            return box_if_finite<2>(moved[tree.references[leaf.first]]);
        },
        [&](std::uint32_t node) { rotate_below(tree, node); });
    put_parents_first(tree);
    return tree;
}

FollowedTree followed(std::string_view name, BvhNodes<2> nodes, std::span<const Segment> moved,
                      const Ray2& ray) {
    FollowedTree tree{.name = name, .nodes = std::move(nodes)};
    tree.expected = tree.nodes.sah_cost({1.0, 1.0});
    struct Watcher {
        std::vector<std::uint32_t>& visited;
        void observe(const BvhVisit& event) { visited.push_back(event.node); }
    };
    NoCounts none;
    walk_bvh(
        tree.nodes, ray, none,
        [&](const BvhNode<2>& leaf) {
            tree.tested.push_back(tree.nodes.references[leaf.first]);
            return tree.nearest =
                       std::min(tree.nearest, distance_along(ray, moved[tree.tested.back()]));
        },
        Watcher{tree.visited});
    return tree;
}

void draw_followed(Svg& svg, const PlaneView& view, const FollowedTree& tree) {
    for (std::uint32_t i = 0; i < tree.nodes.nodes.size(); ++i) {
        const BvhNode<2>& node = tree.nodes.nodes[i];
        if (i == 1 || node.is_leaf()) continue;  // the gap is no node
        const Point2 low = view(Double2(node.box.min)), high = view(Double2(node.box.max));
        const bool is_visited = std::ranges::find(tree.visited, i) != tree.visited.end();
        svg.rect(at(low.x, high.y), at(high.x - low.x, low.y - high.y),
                 {.stroke = is_visited ? Ink::blue : Ink::quiet,
                  .fill = is_visited ? std::optional(Ink::blue) : std::nullopt,
                  .opacity = 0.1,
                  .dashed = !is_visited});
    }
}

void draw_walkers(Svg& svg, const PlaneView& view, std::span<const Segment> walkers, Ink ink,
                  const std::vector<std::uint32_t>& tested = {}) {
    for (std::uint32_t i = 0; i < walkers.size(); ++i) {
        const bool is_tested = std::ranges::find(tested, i) != tested.end();
        draw_segment(svg, view, Double2(walkers[i].a), Double2(walkers[i].b),
                     {.stroke = {}, .fill = is_tested ? Ink::vermillion : ink});
    }
}

/// As far as its hit, or as the square reaches.
void draw_ray(Svg& svg, const PlaneView& view, const Ray2& ray, double nearest) {
    const Aabb2 square{Point2(0.0f), Point2(static_cast<float>(square_side))};
    const double leave = BvhRay<2>(ray, BoxMargins::none).span_in(square, infinity).leave;
    const bool is_hit = nearest < double{infinity};
    const auto place = [&](double t) {
        return view(Double2(ray.origin) + t * Double2(ray.direction));
    };
    svg.line(place(0.0), place(is_hit ? nearest : std::max(leave, 0.0)), {.stroke = Ink::green});
    svg.circle(place(0.0), 3.5, {.stroke = {}, .fill = Ink::green});
    if (is_hit) svg.circle(place(nearest), 6.0, {.stroke = Ink::green});
}

}  // namespace

std::vector<Segment> walkers_at_rest() {
    return {{{1.5f, 2.5f}, {2.5f, 3.25f}},     {{3.5f, 1.5f}, {3.0f, 2.5f}},
            {{12.5f, 2.25f}, {13.5f, 2.75f}},  {{14.0f, 1.0f}, {14.5f, 2.0f}},
            {{1.5f, 13.0f}, {2.0f, 14.0f}},    {{3.5f, 14.25f}, {4.5f, 13.75f}},
            {{12.0f, 13.5f}, {13.0f, 13.75f}}, {{14.5f, 12.5f}, {14.0f, 13.5f}}};
}

std::array<FollowedTree, 3> followed_trees(std::span<const Segment> rest,
                                           std::span<const Segment> moved, const Ray2& ray) {
    const BvhNodes<2> first = tree_around(rest);
    return {followed("refitted", with_new_boxes(first, moved), moved, ray),
            followed("with rotations", with_rotated_nodes(first, moved), moved, ray),
            followed("built anew", tree_around(moved), moved, ray)};
}

Svg drawn_refits(std::span<const Segment> rest, std::span<const Segment> moved, const Ray2& ray,
                 const std::array<FollowedTree, 3>& trees) {
    Svg svg("Boxes around eight walkers who have crossed a square, in three trees, and a ray", 656,
            292);
    PlaneView view = refits_view;
    for (const FollowedTree& tree : trees) {
        const double side = view.scale * view.size;
        const Point2 corner(view.corner);
        svg.text(space::moved(corner, 0.5 * side, -12), tree.name, {.bold = true});
        svg.rect(corner, at(side, side), {.stroke = Ink::faint});
        draw_walkers(svg, view, rest, Ink::faint);
        draw_followed(svg, view, tree);
        draw_ray(svg, view, ray, tree.nearest);
        draw_walkers(svg, view, moved, Ink::ink, tree.tested);
        svg.text(space::moved(corner, 0.5 * side, side + 24),
                 fmt::format("expected cost {:.1f}", tree.expected), {.size = 17});
        svg.text(space::moved(corner, 0.5 * side, side + 46),
                 fmt::format("this ray: {} node{}, {} test{}", tree.visited.size(),
                             tree.visited.size() == 1 ? "" : "s", tree.tested.size(),
                             tree.tested.size() == 1 ? "" : "s"),
                 {.size = 17});
        view.corner.x += side + 20;
    }
    return svg;
}

}  // namespace space::ch09
