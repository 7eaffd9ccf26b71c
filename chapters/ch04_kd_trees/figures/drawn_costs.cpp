#include "chapters/ch04_kd_trees/figures/drawn_costs.hpp"

#include "chapters/ch04_kd_trees/clipped_bounds.hpp"
#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"
#include "chapters/ch04_kd_trees/sah_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace space::ch04 {
namespace {

constexpr double scale = 50, left = 32;  // of the drawing

Aabb2 box_in_cell(const Segment& segment, const Aabb2& cell) {
    Aabb2 box;
    box.extend(segment.a);
    box.extend(segment.b);
    return {glm::max(box.min, cell.min), glm::min(box.max, cell.max)};
}

/// What the sweep has to say about planes across the axis.
struct Sweep {
    Aabb2 cell;
    int axis;
    std::vector<Aabb2> boxes;
    std::vector<SahCandidate> candidates = {};
    std::optional<SahCandidate> best = {};  ///< none where no box begins or ends in the cell

    Sweep(const CostScene& scene, std::vector<Aabb2> of)
        : cell(scene.cell), axis(scene.axis), boxes(std::move(of)) {
        SplitEvents<2> events;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) add_events<2>(events, boxes[i], i);
        for (auto& list : events) std::sort(list.begin(), list.end());
        events[axis == 0 ? 1 : 0].clear();  // planes across this axis only
        best_split<2>(events, cell, boxes.size(), costs(), *this);
        if (!candidates.empty())
            best = *std::ranges::min_element(candidates, {}, &SahCandidate::cost);
    }
    void observe(const SahCandidate& candidate) { candidates.push_back(candidate); }
    static SahCosts costs() { return {}; }

    /// How many boxes reach below the plane, or lie in it, and how many above.
    std::pair<std::size_t, std::size_t> counts(float plane) const {
        std::size_t below = 0, above = 0;
        for (const Aabb2& box : boxes) {
            const bool reaches_above = box.max[axis] > plane;
            above += reaches_above;
            below += box.min[axis] < plane || !reaches_above;
        }
        return {below, above};
    }
    double cost(float at, float counted_at) const {
        const auto [below, above] = counts(counted_at);
        return SahCost<2>(cell, axis, costs())(at, below, above, boxes.size());
    }
    /// Between two starts or ends the counts are what they are in the middle.
    std::vector<std::array<Double2, 2>> pieces() const {
        std::vector<float> ends{cell.min[axis], cell.max[axis]};
        for (const Aabb2& box : boxes) ends.insert(ends.end(), {box.min[axis], box.max[axis]});
        std::ranges::sort(ends);
        std::vector<std::array<Double2, 2>> lines;
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            const float middle = 0.5f * (ends[i] + ends[i + 1]);
            if (ends[i] < ends[i + 1])
                lines.push_back({Double2(ends[i], cost(ends[i], middle)),
                                 Double2(ends[i + 1], cost(ends[i + 1], middle))});
        }
        return lines;
    }
};

/// A segment's part in a box.
void draw_part(Svg& svg, const PlaneView& view, const Segment& segment, const Aabb2& box, Ink ink) {
    const Style style{.stroke = {}, .fill = ink};
    const Double2 from(segment.a), way = Double2(Vector2(segment.b - segment.a));
    if (segment.a == segment.b) return draw_segment(svg, view, from, from, style);
    const Ray2 along{segment.a, segment.b - segment.a, 0.0f, 1.0f};
    if (const auto part = part_in(box, KdRay<2>(along), RayPart::all_of(along)))
        draw_segment(svg, view, from + part->enter * way, from + part->leave * way, style);
}

/// The cell with a rim about it, and the three long segments' boxes.
void draw_cell(Svg& svg, const CostScene& scene, const Sweep& whole, const Sweep& clipped) {
    const PlaneView view = costs_view();
    for (std::size_t i = 0; i < 3; ++i)
        svg.polygon(view(corners_of(whole.boxes[i])),
                    {.stroke = {}, .fill = Ink::orange, .opacity = 0.14});
    for (std::size_t i = 0; i < 3; ++i)
        svg.polygon(view(corners_of(clipped.boxes[i])),
                    {.stroke = Ink::blue, .fill = Ink::sky, .opacity = 0.3});
    svg.polygon(view(corners_of(scene.cell)), {.stroke = Ink::ink}, "cell");
    const Vector2 rim(0.5f);
    for (const Segment& segment : scene.segments) {
        draw_part(svg, view, segment, {scene.cell.min - rim, scene.cell.max + rim}, Ink::faint);
        draw_part(svg, view, segment, scene.cell, Ink::ink);
    }
    if (!scene.plane) return;
    const auto [from, to] = line_in_cell(scene.cell, {scene.axis, *scene.plane});
    svg.line(view(from), view(to), {.stroke = Ink::green});
}

/// Costs from `least` on, over the cell: as many units as there is room for.
struct Plot {
    double along;       ///< drawing units for one of the axis
    double leaf;        ///< the cost without a plane
    double least, top;  ///< of the axis of costs
    double unit = 50;
    static constexpr double bottom = 546, height = 276;

    Plot(const CostScene& scene, const Sweep& whole, const Sweep& clipped)
        : along(12.0 * scale / double{scene.cell.max[scene.axis]}),
          leaf(Sweep::costs().intersection * static_cast<double>(whole.boxes.size())),
          least(4),
          top(leaf + 1.9) {
        double most = top;
        for (const Sweep* sweep : {&whole, &clipped})
            for (const auto& piece : sweep->pieces())
                for (const Double2& end : piece) {
                    least = std::min(least, std::floor(end.y));
                    most = std::max(most, end.y);
                }
        if ((most - least) * unit <= height) return;
        unit = height / (most - least);
        top = most;
    }
    Point2 operator()(double x, double cost) const {
        return at(left + along * x, bottom - unit * (cost - least));
    }
};

void draw_axes(Svg& svg, const Plot& plot, const CostScene& scene) {
    const auto right = static_cast<double>(scene.cell.max[scene.axis]);
    svg.line(plot(0, plot.least), plot(right, plot.least), {.stroke = Ink::quiet, .arrow = true});
    svg.line(plot(0, plot.least), plot(0, plot.top), {.stroke = Ink::quiet, .arrow = true});
    for (double cost = plot.least; cost <= plot.top - 0.9; ++cost)
        svg.text(moved(plot(0, cost), -8, 6), svg_number(cost),
                 {.anchor = Anchor::end, .size = 17});
    svg.line(plot(0, plot.leaf), plot(right, plot.leaf), {.stroke = Ink::quiet, .dashed = true});
    svg.text(moved(plot(0, plot.leaf), 8, 22), "no plane: a leaf",
             {.anchor = Anchor::start, .ink = Ink::quiet, .size = 17});
    svg.text(moved(plot(right, plot.least), 0, 24), scene.axis == 0 ? "*x*" : "*y*", {.size = 18});
    svg.text(moved(plot(0, plot.top), 12, 8), "cost", {.anchor = Anchor::start, .size = 17});
}

void draw_curve(Svg& svg, const Plot& plot, const Sweep& sweep, Ink ink, bool dashed) {
    for (const auto& [from, to] : sweep.pieces())
        svg.line(plot(from.x, from.y), plot(to.x, to.y), {.stroke = ink, .dashed = dashed});
    for (const SahCandidate& candidate : sweep.candidates)
        svg.circle(plot(static_cast<double>(candidate.split.position), candidate.cost), 4,
                   {.stroke = {}, .fill = ink});
    if (!sweep.best) return;
    const Point2 best = plot(static_cast<double>(sweep.best->split.position), sweep.best->cost);
    svg.circle(best, 9, {.stroke = ink});
    const bool fits = double{best.x} > left + 50;
    svg.text(moved(best, fits ? -14 : 14, 20), fmt::format("{:.1f}", sweep.best->cost),
             {.anchor = fits ? Anchor::end : Anchor::start, .ink = ink, .size = 18, .halo = true});
}

/// The plane that is asked for, with its costs, on the side where there is room.
void draw_plane(Svg& svg, const Plot& plot, float plane, const Sweep& whole, const Sweep& clipped) {
    const auto x = static_cast<double>(plane);
    svg.line(plot(x, plot.least), plot(x, plot.top), {.stroke = Ink::green});
    const bool right = plot.along * x < 6.0 * scale;
    double y = -28;
    for (const auto& [sweep, ink] : {std::pair{&whole, Ink::vermillion}, {&clipped, Ink::blue}}) {
        const auto [below, above] = sweep->counts(plane);
        const double cost = sweep->cost(plane, plane);
        svg.circle(plot(x, cost), 5, {.stroke = Ink::paper, .fill = ink});
        svg.text(
            moved(plot(x, plot.least), right ? 10 : -10, y),
            fmt::format("{} below, {} above: {:.2f}", below, above, cost),
            {.anchor = right ? Anchor::start : Anchor::end, .ink = ink, .size = 17, .halo = true});
        y += 19;
    }
}

std::string best_of(const Sweep& sweep) {
    if (!sweep.best) return "no plane is to be tried";
    const auto& [split, cost, below, above] = *sweep.best;
    const bool leaf = cost >= Sweep::costs().intersection * double(sweep.boxes.size());
    return fmt::format("the cheapest plane is {} = {:.2f} with a cost of {:.2f}{}",
                       "xy"[split.axis], split.position, cost, leaf ? ", no less than a leaf" : "");
}

}  // namespace

PlaneView costs_view() {
    return {.corner = {left, 40}, .scale = scale, .size = 4.5};
}

DrawnCosts drawn_costs(const CostScene& scene) {
    std::vector<Aabb2> boxes, parts;
    for (const Segment& segment : scene.segments) {
        boxes.push_back(box_in_cell(segment, scene.cell));
        parts.push_back(clipped_bounds<2>(segment, boxes.back()));
    }
    const Sweep whole(scene, boxes), clipped(scene, parts);
    Svg svg(
        "A cell with seven segments, and below it the cost of planes across it, with boxes of "
        "whole segments and with boxes of their parts in the cell",
        660, 578);
    draw_cell(svg, scene, whole, clipped);
    const Plot plot(scene, whole, clipped);
    draw_axes(svg, plot, scene);
    draw_curve(svg, plot, whole, Ink::vermillion, true);
    draw_curve(svg, plot, clipped, Ink::blue, false);
    if (scene.plane) draw_plane(svg, plot, *scene.plane, whole, clipped);
    std::string tells = fmt::format("By boxes of parts {}; by boxes of whole segments {}.",
                                    best_of(clipped), best_of(whole));
    if (scene.plane)
        tells += fmt::format(" The plane at {:.2f} costs {:.2f} and {:.2f}.", *scene.plane,
                             clipped.cost(*scene.plane, *scene.plane),
                             whole.cost(*scene.plane, *scene.plane));
    return {.drawing = std::move(svg), .tells = std::move(tells)};
}

}  // namespace space::ch04
