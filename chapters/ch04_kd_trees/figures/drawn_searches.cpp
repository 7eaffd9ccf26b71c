#include "chapters/ch04_kd_trees/figures/drawn_searches.hpp"

#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"
#include "chapters/ch04_kd_trees/point_search.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch04 {
namespace {

constexpr double size = 10.0, side = 308;

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

std::string_view word(std::size_t number) {
    constexpr std::array words{"none",  "one",   "two",  "three", "four",   "five",  "six",
                               "seven", "eight", "nine", "ten",   "eleven", "twelve"};
    return words[std::min(number, words.size() - 1)];
}
std::string nearest_so_many(std::size_t k) {
    return k == 1 ? "the nearest" : fmt::format("the {} nearest", word(k));
}

/// A circle, or what of it lies over the tree's cells.
void draw_circle(Svg& svg, const Panel& panel, const Double2& middle, double radius) {
    const PlaneView& view = panel.view;
    const Double2 low(panel.tree.bounds.min), high(panel.tree.bounds.max);
    const Style style{.stroke = Ink::vermillion, .dashed = true};
    const Double2 room = glm::min(middle - low, high - middle);
    if (radius <= std::min(room.x, room.y))
        return svg.circle(view(middle), view.scale * radius, style);
    constexpr int parts = 360;
    std::vector<Point2> arc;
    for (int i = 0; i <= parts; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / parts;
        const Double2 p = middle + radius * Double2(std::cos(angle), std::sin(angle));
        const bool inside = glm::clamp(p, low, high) == p;
        if (inside) arc.push_back(view(p));
        if (inside && i < parts) continue;
        if (arc.size() > 1) svg.polyline(arc, style);
        arc.clear();
    }
}

/// How far the farthest of the nearest is away.
double draw_nearest(Svg& svg, Panel& panel, const Searches& asked) {
    NearestSearch<2> search(panel.tree, asked.k);
    const auto best = search(asked.query, panel.watcher);
    for (const Neighbour& neighbour : best) panel.watcher.found.insert(neighbour.index);
    panel.draw_cells(svg);
    const double radius = best.empty() ? 0.0 : std::sqrt(best.back().squared_distance);
    draw_circle(svg, panel, Double2(asked.query), radius);
    panel.draw_points(svg);
    svg.circle(panel.view(Double2(asked.query)), 5,
               {.stroke = Ink::paper, .fill = Ink::vermillion});
    panel.draw_legend(svg, nearest_so_many(asked.k));
    return radius;
}

void draw_range(Svg& svg, Panel& panel, const Aabb2& box) {
    std::vector<std::uint32_t> inside;
    within_box(panel.tree, box, inside, panel.watcher);
    panel.watcher.found.insert(inside.begin(), inside.end());
    panel.draw_cells(svg);
    svg.polygon(panel.view(corners_of(box)), {.stroke = Ink::vermillion, .dashed = true});
    panel.draw_points(svg);
    panel.draw_legend(svg, "all in a box");
}

}  // namespace

PlaneView search_view(std::size_t search) {
    return {.corner = {search == 0 ? 4 : 328, 30}, .scale = side / size, .size = size};
}

DrawnSearches drawn_searches(const Searches& asked) {
    const std::vector<Point2> points = uneven_points();
    const auto tree = KdPoints<2>::build(points);
    Svg svg(fmt::format("Two searches among points: {} to a place, and all in a box",
                        nearest_so_many(asked.k)),
            640, 34 + side + 56);
    Panel nearest{tree, points, {}, search_view(0)}, range{tree, points, {}, search_view(1)};
    const double radius = draw_nearest(svg, nearest, asked);
    draw_range(svg, range, asked.box);
    return {.drawing = std::move(svg),
            .tells = fmt::format(
                "{} lie within {:.2f}, found in {} of {} cells; {} points are in the box, found in "
                "{} cells.",
                nearest.watcher.found.size(), radius, nearest.watcher.buckets.size(),
                tree.buckets.size(), range.watcher.found.size(), range.watcher.buckets.size())};
}

}  // namespace space::ch04
