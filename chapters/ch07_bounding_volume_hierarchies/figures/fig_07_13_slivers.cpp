// Slivers along the diagonal of a cube, in two trees: one keeps them whole, in the other planes may
// cut them. Seen along the z axis.

#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

namespace space::ch07 {
namespace {

constexpr double view_side = 300, view_size = 16;
constexpr BvhCosts sliver_costs{1.0, 1.0};

std::vector<Triangle> slivers() {
    std::vector<Triangle> all;
    Pcg32 random(3);
    while (all.size() < 12) {
        const Point3 from = random_point(random, 0.5f, 3.5f),
                     to = random_point(random, 12.5f, 15.5f);
        all.push_back({from, to, from + Vector3(0.05f, -0.05f, 0.05f)});
    }
    return all;
}

struct PlaneWatcher : NoObserver {
    using NoObserver::observe;
    std::optional<SpatialSplit> of_root = {};
    void observe(const SpatialSplitBuild<3>::Chosen& event) {
        if (event.task.node == 0) of_root = event.choice.plane;
    }
};

Aabb2 seen(const Aabb& box) {
    return {Point2(box.min), Point2(box.max)};
}

void draw_slivers(Svg& svg, const PlaneView& view) {
    for (const Triangle& sliver : slivers())
        draw_segment(svg, view, Double2(sliver.a), Double2(sliver.b),
                     {.stroke = {}, .fill = Ink::ink});
}

/// The root's two children, and below them all leaves.
void draw_column(Svg& svg, double left, const std::string& name, const BvhNodes<3>& tree,
                 const std::optional<SpatialSplit>& plane) {
    const PlaneView above{.corner = {left, 34}, .scale = view_side / view_size, .size = view_size},
        below{.corner = {left, 34 + view_side + 16},
              .scale = view_side / view_size,
              .size = view_size};
    svg.text(at(left + 0.5 * view_side, 22), name, {.bold = true});
    const std::uint32_t pair = tree.nodes[0].first;
    for (const std::uint32_t i : {0u, 1u})
        draw_box(svg, above, seen(tree.nodes[pair + i].box), 3,
                 {.stroke = i == 0 ? Ink::blue : Ink::vermillion,
                  .fill = i == 0 ? Ink::sky : Ink::orange,
                  .opacity = 0.3});
    draw_slivers(svg, above);
    if (plane && plane->axis < 2) {
        Double2 from(0.0), to(view_size);
        from[plane->axis] = to[plane->axis] = double{plane->position};
        svg.line(above(from), above(to), {.stroke = Ink::green, .dashed = true});
    }
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        if (tree.nodes[index].is_leaf())
            draw_box(svg, below, seen(tree.nodes[index].box), 0,
                     {.stroke = Ink::blue, .fill = Ink::sky, .opacity = 0.2});
    });
    draw_slivers(svg, below);
    svg.text(at(left + 0.5 * view_side, 34 + 2 * view_side + 42),
             fmt::format("{} references, expected cost {:.1f}", tree.references.size(),
                         tree.sah_cost(sliver_costs)),
             {.size = 17});
}

}  // namespace

Svg fig_07_13(const Options&) {
    Svg svg(
        "Slivers along a cube's diagonal in two trees: kept whole, all boxes overlap; cut by "
        "planes, they hardly do",
        660, 34 + 2 * view_side + 58);
    draw_column(svg, 12, "slivers stay whole",
                SweepBuilder::build<3>(slivers(), {.costs = sliver_costs}), {});
    PlaneWatcher watcher;
    const BvhNodes<3> cut = SpatialSplitBuilder::build<3>(
        slivers(), {.costs = sliver_costs, .max_growth = 4.0}, watcher);
    draw_column(svg, 348, "planes may cut them", cut, watcher.of_root);
    return svg;
}

}  // namespace space::ch07
