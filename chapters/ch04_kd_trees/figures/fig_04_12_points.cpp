// What two searches look at in a tree of points.

#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"
#include "chapters/ch04_kd_trees/point_search.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace space::ch04 {
namespace {

constexpr double size = 10.0, side = 308;
const Point2 query{4.4f, 5.4f};

/// Most of them about three places.
std::vector<Point2> uneven_points() {
    const Point2 places[] = {{2.6f, 6.8f}, {6.8f, 3.2f}, {7.6f, 7.8f}};
    std::vector<Point2> points;
    Pcg32 random(11);
    while (points.size() < 160) {
        const Point2 p = random_point(random, Aabb2{{0.3f, 0.3f}, {9.7f, 9.7f}});
        float away = infinity;
        for (const Point2& place : places) away = std::min(away, glm::length(p - place));
        if (random.uniform() < std::exp(-0.8f * away)) points.push_back(p);
    }
    return points;
}

/// What a search told.
struct Watcher : NoObserver {
    using NoObserver::observe;
    std::set<std::uint32_t> buckets = {}, compared = {}, found = {};

    void observe(const PointSearch<2>::Visited& event) {
        if (event.subtree.is_bucket()) buckets.insert(event.subtree.first);
    }
    void observe(const PointSearch<2>::Compared& event) { compared.insert(event.index); }
};

/// Calls visit(bucket, cell) for every bucket; a cell holds no more than its points need on the
/// axes that were cut.
template <class Visit>
void for_each_bucket(const KdPoints<2>& tree, const KdPoints<2>::Subtree& subtree, Aabb2 cell,
                     const Visit& visit) {
    if (subtree.is_bucket()) {
        visit(subtree.first, cell);
        return;
    }
    const KdPoints<2>::Node& node = tree.node(subtree);
    const auto axis = static_cast<int>(node.axis);
    Aabb2 left = cell, right = cell;
    left.max[axis] = node.left;
    right.min[axis] = node.right;
    for_each_bucket(tree, subtree.left(), left, visit);
    for_each_bucket(tree, subtree.right(), right, visit);
}

struct Panel {
    const KdPoints<2>& tree;
    std::span<const Point2> points;
    Watcher watcher;
    PlaneView view;

    void draw_cells(Svg& svg) const {
        for_each_bucket(tree, tree.root(), tree.bounds,
                        [&](std::uint32_t bucket, const Aabb2& cell) {
                            Style style{.stroke = Ink::faint};
                            if (watcher.buckets.contains(bucket))
                                style = {.stroke = Ink::blue, .fill = Ink::sky, .opacity = 0.35};
                            svg.polygon(view(corners_of(cell)), style);
                        });
    }
    void draw_points(Svg& svg) const {
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            const bool found = watcher.found.contains(i), seen = watcher.compared.contains(i);
            svg.circle(view(Double2(points[i])), found ? 4.5 : 3,
                       {.stroke = {},
                        .fill = found  ? Ink::green
                                : seen ? Ink::blue
                                       : Ink::quiet});
        }
    }
    void draw_legend(Svg& svg, std::string_view title) const {
        const double middle = view.corner.x + 0.5 * side;
        svg.text(at(middle, 20), title, {.size = 18, .bold = true});
        svg.text(at(middle, 34 + side + 22),
                 fmt::format("{} of {} cells", watcher.buckets.size(), tree.buckets.size()),
                 {.size = 17});
        svg.text(at(middle, 34 + side + 46),
                 fmt::format("{} of {} points compared", watcher.compared.size(), points.size()),
                 {.size = 17});
    }
};

}  // namespace

Svg fig_04_12(const Options&) {
    const std::vector<Point2> points = uneven_points();
    const auto tree = KdPoints<2>::build(points);
    Svg svg("Two searches among points: the six nearest to a place, and all in a box", 640,
            34 + side + 56);
    const auto view_at = [](double left) {
        return PlaneView{.corner = {left, 30}, .scale = side / size, .size = size};
    };
    Panel nearest{tree, points, {}, view_at(4)};
    NearestSearch<2> search(tree, 6);
    const auto best = search(query, nearest.watcher);
    for (const Neighbour& neighbour : best) nearest.watcher.found.insert(neighbour.index);
    nearest.draw_cells(svg);
    const double radius = std::sqrt(best.back().squared_distance);
    svg.circle(nearest.view(Double2(query)), side / size * radius,
               {.stroke = Ink::vermillion, .dashed = true});
    nearest.draw_points(svg);
    svg.circle(nearest.view(Double2(query)), 5, {.stroke = Ink::paper, .fill = Ink::vermillion});
    nearest.draw_legend(svg, "the six nearest");

    Panel range{tree, points, {}, view_at(328)};
    const Aabb2 box{{3.4f, 4.0f}, {6.4f, 7.6f}};
    std::vector<std::uint32_t> inside;
    within_box(tree, box, inside, range.watcher);
    range.watcher.found.insert(inside.begin(), inside.end());
    range.draw_cells(svg);
    svg.polygon(range.view(corners_of(box)), {.stroke = Ink::vermillion, .dashed = true});
    range.draw_points(svg);
    range.draw_legend(svg, "all in a box");
    return svg;
}

}  // namespace space::ch04
