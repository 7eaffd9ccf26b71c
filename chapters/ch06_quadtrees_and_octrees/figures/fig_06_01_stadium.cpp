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

constexpr double size = 128.0, side = 316, pot_size = 1.0;
const Double2 pot_at{81.3, 45.7};  ///< on the field, not where cells of any size begin
const OrthtreeBox<2> lens{pot_at - 0.75 * pot_size, pot_at + 0.75 * pot_size};

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

/// Two rings of walls, the lines of a field, and on it a teapot, seen from the side.
std::vector<Segment> stadium() {
    std::vector<Segment> segments;
    const Double2 middle(0.5 * size);
    for (const double width : {0.96, 0.8})
        add_polyline(segments, arc(middle, 0.5 * width * Double2(size, 0.74 * size), 0, 1, 36));
    const Double2 half{34.0, 21.0};
    add_polyline(segments, {middle - half, middle + Double2(half.x, -half.y), middle + half,
                            middle + Double2(-half.x, half.y), middle - half});
    add_polyline(segments, {middle - Double2(0, half.y), middle + Double2(0, half.y)});
    add_polyline(segments, arc(middle, Double2(7.0), 0, 1, 24));

    const auto add = [&](Double2 at, Double2 radius, double from, double to, int pieces) {
        add_polyline(segments, arc(pot_at + pot_size * at, pot_size * radius, from, to, pieces));
    };
    add({0.0, 0.0}, {0.30, 0.26}, -0.18, 0.68, 44);       // the body, without its foot
    add({0.0, -0.235}, {0.127, 0.03}, 0.5, 1.0, 12);      // the foot
    add({0.0, 0.235}, {0.15, 0.07}, 0.0, 0.5, 16);        // the lid
    add({0.0, 0.335}, {0.035, 0.035}, -0.2, 0.7, 14);     // its knob
    add({-0.28, 0.04}, {0.17, 0.13}, 0.12, 0.84, 22);     // the handle, outside and inside
    add({-0.28, 0.04}, {0.12, 0.08}, 0.16, 0.80, 18);
    add({0.27, 0.27}, {0.22, 0.20}, 0.75, 0.98, 14);      // the spout, above and below
    add({0.24, 0.24}, {0.25, 0.32}, 0.75, 0.98, 14);
    return segments;
}

/// A tree's cells, its size, and what rays do in it.
struct Panel {
    const char* name;
    std::vector<OrthtreeBox<2>> leaves = {};
    std::size_t nodes = 0, depth = 0;
    double visits = 0;  ///< a ray
};

/// From all around towards the pot.
template <class Walk>
double visits_of_rays(const Walk& walk) {
    constexpr int rays = 64;
    std::size_t visits = 0;
    for (const Double2& from : arc(pot_at, Double2(0.3 * size), 0.01, 1.01, rays))
        walk(Ray2{.origin = Point2(from), .direction = Point2(pot_at) - Point2(from)}, visits);
    return double(visits) / (rays + 1);
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

struct VisitCounter {
    std::size_t& visits;
    template <class Event>
    void observe(const Event&) const {
        ++visits;
    }
};

Panel quadtree(const std::vector<Segment>& segments) {
    Panel panel{.name = "quadtree"};
    const OrthtreeNodes<2> tree = OrthtreeBuilder<2>::build(segments);
    tree.for_each_cell([&](std::uint32_t, const OrthtreeCell<2>& cell) {
        panel.leaves.push_back(tree.frame.box(cell));
    });
    panel.nodes = tree.nodes.size();
    panel.depth = tree.depth;
    panel.visits = visits_of_rays([&](const Ray2& ray, std::size_t& visits) {
        Nearest nearest(segments, ray);
        NoCounts none;
        walk_orthtree(
            tree, OctreeConfig::Walk::parametric, ray, none,
            [&](std::uint32_t node) { return nearest.own(tree, node); }, VisitCounter{visits});
    });
    return panel;
}

struct CellWatcher : NoObserver {
    using NoObserver::observe;
    Panel& panel;

    explicit CellWatcher(Panel& to) : panel(to) {}
    void observe(const KdBuilder<2>::Chosen& event) {
        panel.depth = std::max(panel.depth, event.depth);
        if (!event.split)
            panel.leaves.push_back({Double2(event.cell.min), Double2(event.cell.max)});
    }
};

Panel kd_tree(const std::vector<Segment>& segments) {
    Panel panel{.name = "k-d tree, by areas"};
    CellWatcher watcher(panel);
    const KdNodes<2> tree = KdBuilder<2>::build(segments, {}, watcher);
    panel.nodes = tree.nodes.size();
    panel.visits = visits_of_rays([&](const Ray2& ray, std::size_t& visits) {
        Nearest nearest(segments, ray);
        NoCounts none;
        walk_cells(
            tree, ray, none, [&](std::uint32_t node) { return nearest.own(tree, node); },
            VisitCounter{visits});
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
    const PlaneView all{.corner = {left, 34}, .scale = side / size, .size = size};
    const double zoom = side / (lens.max.x - lens.min.x), below = 34 + side + 46;
    // The lens's own view: its lower left corner stands where the plane's is in the other.
    const PlaneView near{.corner = {left - zoom * lens.min.x, below + zoom * lens.min.y},
                         .scale = zoom,
                         .size = lens.max.y - lens.min.y};
    svg.text(at(left + 0.5 * side, 22), panel.name, {.bold = true});
    draw_cells(svg, all, panel, {Double2(0.0), Double2(size)});
    for (const Segment& s : segments) {
        const bool in_lens = common_part({Double2(s.a), Double2(s.a)}, lens).min == Double2(s.a);
        if (!in_lens) svg.line(all(Double2(s.a)), all(Double2(s.b)));
    }
    const Point2 pot = all(pot_at);
    for (const double x : {left, left + side})
        svg.line(pot, at(x, below), {.stroke = Ink::quiet, .dashed = true});
    svg.circle(pot, 3.5, {.stroke = Ink::paper, .fill = Ink::vermillion});
    svg.rect(at(left, below), at(side, side), {.stroke = {}, .fill = Ink::paper});
    draw_cells(svg, near, panel, lens);
    svg.rect(at(left, below), at(side, side), {.stroke = Ink::quiet});
    for (const Segment& s : segments)
        if (common_part({Double2(s.a), Double2(s.a)}, lens).min == Double2(s.a))
            svg.line(near(Double2(s.a)), near(Double2(s.b)), {.stroke = Ink::vermillion});
    svg.text(at(left + 0.5 * side, below + side + 26),
             fmt::format("{} nodes, depth {}", panel.nodes, panel.depth), {.size = 17});
    svg.text(at(left + 0.5 * side, below + side + 50),
             fmt::format("a ray to the pot visits {:.1f} nodes", panel.visits), {.size = 17});
}

}  // namespace

Svg fig_06_01(const Options&) {
    const std::vector<Segment> segments = stadium();
    Svg svg(
        "A stadium with a teapot on its field: the cells of a quadtree and of a k-d tree, above in "
        "full, below around the teapot",
        656, 34 + 2 * side + 46 + 62);
    draw_panel(svg, quadtree(segments), segments, 4);
    draw_panel(svg, kd_tree(segments), segments, 656 - 4 - side);
    return svg;
}

}  // namespace space::ch06
