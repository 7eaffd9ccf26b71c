// The teapot in the stadium: the cells of a quadtree and of a k-d tree, and both through a lens.

#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures/plane_cells.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_builder.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_walk.hpp"
#include "common/program/walk_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace space::ch06 {
namespace {

constexpr double stadium_size = 128.0, stadium_side = 316, pot_size = 0.5;
const Double2 pot_at{83.7, 54.6};  ///< on the field
const OrthtreeBox<2> lens{pot_at - 0.7 * pot_size, pot_at + 0.7 * pot_size};

void add_polyline(std::vector<Segment>& segments, const std::vector<Double2>& points) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        segments.push_back({Point2(points[i]), Point2(points[i + 1])});
}

/// A part of an ellipse, in turns from the right.
std::vector<Double2> arc(Double2 middle, Double2 radius, double from, double to, int pieces) {
    std::vector<Double2> points;
    for (int i = 0; i <= pieces; ++i) {
        const double angle = 2.0 * std::numbers::pi * (from + (to - from) * i / pieces);
        points.push_back(middle + radius * Double2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

/// A parabola that begins at `from` in the direction of `by`, and comes to `to` from there.
std::vector<Double2> bend(Double2 from, Double2 by, Double2 to, int pieces) {
    std::vector<Double2> points;
    for (int i = 0; i <= pieces; ++i) {
        const double t = double(i) / pieces;
        points.push_back((1 - t) * (1 - t) * from + 2 * t * (1 - t) * by + t * t * to);
    }
    return points;
}

/// Seen from the side, its body from -0.3 to 0.3.
std::vector<std::vector<Double2>> teapot_lines() {
    return {arc({0.0, 0.0}, {0.30, 0.26}, 0, 1, 48),
            {{-0.16, -0.22}, {-0.19, -0.29}, {0.19, -0.29}, {0.16, -0.22}},
            bend({-0.19, 0.20}, {-0.14, 0.36}, {0.0, 0.32}, 10),
            bend({0.0, 0.32}, {0.14, 0.36}, {0.19, 0.20}, 10),
            arc({0.0, 0.36}, {0.04, 0.04}, 0, 1, 14),
            bend({-0.27, 0.12}, {-0.42, 0.26}, {-0.48, 0.09}, 10),
            bend({-0.48, 0.09}, {-0.53, -0.08}, {-0.285, -0.08}, 10),
            bend({-0.29, 0.07}, {-0.39, 0.18}, {-0.425, 0.07}, 8),
            bend({-0.425, 0.07}, {-0.46, -0.03}, {-0.298, -0.03}, 8),
            bend({0.27, -0.12}, {0.42, -0.10}, {0.46, 0.18}, 14),
            bend({0.298, 0.03}, {0.36, 0.04}, {0.38, 0.20}, 10),
            {{0.46, 0.18}, {0.50, 0.225}, {0.36, 0.225}, {0.38, 0.20}}};
}

/// Two rings of walls, the lines of a field, and on it a teapot.
std::vector<Segment> stadium() {
    std::vector<Segment> segments;
    const Double2 middle(0.5 * stadium_size);
    for (const double width : {0.96, 0.8})
        add_polyline(segments, arc(middle, 0.5 * width * Double2(stadium_size, 0.74 * stadium_size),
                                   0, 1, 36));
    const Double2 half{34.0, 21.0};
    add_polyline(segments, {middle - half, middle + Double2(half.x, -half.y), middle + half,
                            middle + Double2(-half.x, half.y), middle - half});
    add_polyline(segments, {middle - Double2(0, half.y), middle + Double2(0, half.y)});
    add_polyline(segments, arc(middle, Double2(7.0), 0, 1, 24));
    for (std::vector<Double2> line : teapot_lines()) {
        for (Double2& point : line) point = pot_at + pot_size * point;
        add_polyline(segments, line);
    }
    return segments;
}

bool is_in(const OrthtreeBox<2>& box, const Double2& p) {
    return p.x >= box.min.x && p.y >= box.min.y && p.x <= box.max.x && p.y <= box.max.y;
}
/// Around the pot's middle, and no larger than two pots.
bool is_at_pot(const OrthtreeBox<2>& cell) {
    const Double2 edges = cell.max - cell.min;
    return is_in(cell, pot_at) && std::max(edges.x, edges.y) <= 2.0 * pot_size;
}

/// A tree's cells, its size, and what rays do in it.
struct Panel {
    const char* name;
    std::vector<OrthtreeBox<2>> leaves = {};
    std::size_t to_pot = 1000;  ///< planes one after the other, down to a cell of its size
    double planes = 0;          ///< that a ray is held against
};

/// From all around towards the pot, with nothing between.
template <class Walk>
double planes_of_rays(const Walk& walk) {
    constexpr int rays = 64;
    std::size_t planes = 0;
    for (const Double2& from : arc(pot_at, Double2(8.0), 0.01, 1.01, rays))
        walk(Ray2{.origin = Point2(from), .direction = Point2(pot_at) - Point2(from)}, planes);
    return double(planes) / (rays + 1);
}

/// The nearest hit so far, among what a node names.
class Nearest {
  public:
    Nearest(const std::vector<Segment>& segments, const Ray2& ray)
        : segments_(segments), ray_(ray) {}
    template <class Tree>
    double own(const Tree& tree, std::uint32_t node) {
        for (const std::uint32_t i : tree.own(node))
            t_ = std::min(t_, distance_along(ray_, segments_[i]));
        return t_;
    }

  private:
    const std::vector<Segment>& segments_;
    const Ray2& ray_;
    double t_ = infinity;
};

template <class Tree>
struct PlaneCounter {
    const Tree& tree;
    std::size_t of_node;  ///< an inner one
    std::size_t& planes;
    template <class Event>
    void observe(const Event& event) const {
        if (!tree.node(event.node).is_leaf()) planes += of_node;
    }
};

Panel quadtree(const std::vector<Segment>& segments) {
    Panel panel{.name = "quadtree"};
    const OrthtreeNodes<2> tree =
        OrthtreeBuilder<2>::build(segments, {.costs = {}, .max_growth = 16});
    tree.for_each_cell([&](std::uint32_t index, const OrthtreeCell<2>& cell) {
        if (is_at_pot(tree.frame.box(cell)))
            panel.to_pot = std::min<std::size_t>(panel.to_pot, 2 * cell.depth);
        for (std::uint32_t k = 0; k < orthants<2>; ++k)
            if (const OrthtreeNode& node = tree.nodes[index]; !node.is_leaf())
                panel.leaves.push_back(tree.frame.box(cell.child(k)));
    });
    panel.planes = planes_of_rays([&](const Ray2& ray, std::size_t& planes) {
        Nearest nearest(segments, ray);
        NoCounts none;
        walk_orthtree(
            tree, OctreeConfig::Walk::parametric, ray, none,
            [&](std::uint32_t node) { return nearest.own(tree, node); },
            PlaneCounter<OrthtreeNodes<2>>{tree, 2, planes});
    });
    return panel;
}

struct CellWatcher : NoObserver {
    using NoObserver::observe;
    Panel& panel;

    explicit CellWatcher(Panel& to) : panel(to) {}
    void observe(const KdBuilder<2>::Chosen& event) {
        const OrthtreeBox<2> cell{Double2(event.cell.min), Double2(event.cell.max)};
        if (is_at_pot(cell)) panel.to_pot = std::min(panel.to_pot, event.depth);
        if (!event.split) panel.leaves.push_back(cell);
    }
};

Panel kd_tree(const std::vector<Segment>& segments) {
    Panel panel{.name = "k-d tree, by areas"};
    CellWatcher watcher(panel);
    const KdNodes<2> tree = KdBuilder<2>::build(segments, {}, watcher);
    panel.planes = planes_of_rays([&](const Ray2& ray, std::size_t& planes) {
        Nearest nearest(segments, ray);
        NoCounts none;
        walk_cells(
            tree, ray, none, [&](std::uint32_t node) { return nearest.own(tree, node); },
            PlaneCounter<KdNodes<2>>{tree, 1, planes});
    });
    return panel;
}

void draw_cells(Svg& svg, const PlaneView& view, const Panel& panel, const OrthtreeBox<2>& within) {
    for (const OrthtreeBox<2>& leaf : panel.leaves) {
        const OrthtreeBox<2> part = common_part(leaf, within);
        if (!is_empty(part)) svg.polygon(view(corners_of(part)), {.stroke = Ink::sky});
    }
}

void draw_panel(Svg& svg, const Panel& panel, const std::vector<Segment>& segments, double left) {
    const PlaneView all{
        .corner = {left, 34}, .scale = stadium_side / stadium_size, .size = stadium_size};
    const double zoom = stadium_side / (lens.max.x - lens.min.x), below = 34 + stadium_side + 46;
    // The lens's own view: its lower left corner stands where the plane's is in the other.
    const PlaneView near{.corner = {left - zoom * lens.min.x, below + zoom * lens.min.y},
                         .scale = zoom,
                         .size = lens.max.y - lens.min.y};
    svg.text(at(left + 0.5 * stadium_side, 22), panel.name, {.bold = true});
    draw_cells(svg, all, panel, {Double2(0.0), Double2(stadium_size)});
    for (const Segment& s : segments)
        if (!is_in(lens, Double2(s.a))) svg.line(all(Double2(s.a)), all(Double2(s.b)));
    const Point2 pot = all(pot_at);
    for (const double x : {left, left + stadium_side})
        svg.line(pot, at(x, below), {.stroke = Ink::quiet, .dashed = true});
    svg.circle(pot, 3.5, {.stroke = Ink::paper, .fill = Ink::vermillion});
    svg.rect(at(left, below), at(stadium_side, stadium_side), {.stroke = {}, .fill = Ink::paper});
    draw_cells(svg, near, panel, lens);
    svg.rect(at(left, below), at(stadium_side, stadium_side), {.stroke = Ink::quiet});
    for (const Segment& s : segments)
        if (is_in(lens, Double2(s.a)))
            svg.line(near(Double2(s.a)), near(Double2(s.b)), {.stroke = Ink::vermillion});
    svg.text(at(left + 0.5 * stadium_side, below + stadium_side + 26),
             fmt::format("{} planes down to the pot", panel.to_pot), {.size = 17});
    svg.text(at(left + 0.5 * stadium_side, below + stadium_side + 50),
             fmt::format("a ray to the pot meets {:.0f}", panel.planes), {.size = 17});
}

}  // namespace

Svg fig_06_01(const Options&) {
    const std::vector<Segment> segments = stadium();
    Svg svg(
        "A stadium with a teapot on its field: the cells of a quadtree and of a k-d tree, above in "
        "full, below around the teapot",
        656, 34 + 2 * stadium_side + 46 + 62);
    draw_panel(svg, quadtree(segments), segments, 4);
    draw_panel(svg, kd_tree(segments), segments, 656 - 4 - stadium_side);
    return svg;
}

}  // namespace space::ch06
