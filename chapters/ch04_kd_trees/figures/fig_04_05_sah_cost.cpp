// The cost of planes across one axis of a cell, by boxes of whole segments and of their parts.

#include "chapters/ch04_kd_trees/clipped_bounds.hpp"
#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/figures/recorded_build.hpp"
#include "chapters/ch04_kd_trees/sah_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace space::ch04 {
namespace {

const Aabb2 cell{{0.0f, 0.0f}, {12.0f, 4.5f}};
constexpr double scale = 50, left = 32;  // of the drawing

/// Three that reach far beyond the cell, and small ones.
std::vector<Segment> segments() {
    return {{{-1.0f, -6.0f}, {12.5f, 21.0f}},  {{0.5f, -5.0f}, {14.0f, 19.0f}},
            {{-2.0f, 6.0f}, {13.75f, -11.5f}}, {{9.0f, 1.0f}, {10.5f, 2.2f}},
            {{10.0f, 3.3f}, {11.5f, 4.1f}},    {{9.25f, 2.9f}, {9.75f, 4.0f}},
            {{11.25f, 0.75f}, {11.5f, 2.75f}}};
}

Aabb2 box_in_cell(const Segment& segment) {
    Aabb2 box;
    box.extend(segment.a);
    box.extend(segment.b);
    return {glm::max(box.min, cell.min), glm::min(box.max, cell.max)};
}

/// What the sweep has to say about planes across x.
struct Sweep {
    std::vector<Aabb2> boxes;
    std::vector<SahCandidate> candidates = {};
    SahCandidate best = {};

    explicit Sweep(std::vector<Aabb2> of) : boxes(std::move(of)) {
        SplitEvents<2> events;
        for (std::uint32_t i = 0; i < boxes.size(); ++i) add_events<2>(events, boxes[i], i);
        for (auto& list : events) std::sort(list.begin(), list.end());
        events[1].clear();  // planes across x only
        best_split<2>(events, cell, boxes.size(), costs(), *this);
        best = *std::ranges::min_element(candidates, {}, &SahCandidate::cost);
    }
    void observe(const SahCandidate& candidate) { candidates.push_back(candidate); }
    static SahCosts costs() { return {}; }

    double cost(float at, float counted_at) const {
        const auto below = std::ranges::count_if(
                       boxes, [&](const Aabb2&box) { return box.min.x < counted_at; }),
                   above = std::ranges::count_if(
                       boxes, [&](const Aabb2&box) { return box.max.x > counted_at; });
        return SahCost<2>(cell, 0, costs())(at, std::size_t(below), std::size_t(above),
                                            boxes.size());
    }
    /// Between two starts or ends the counts are what they are in the middle.
    std::vector<std::array<Double2, 2>> pieces() const {
        std::vector<float> ends{cell.min.x, cell.max.x};
        for (const Aabb2& box : boxes) ends.insert(ends.end(), {box.min.x, box.max.x});
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

/// The cell with a rim about it, and the three long segments' boxes.
void draw_cell(Svg& svg, const Sweep& whole, const Sweep& clipped) {
    const PlaneView view{.corner = {left, 40}, .scale = scale, .size = 4.5};
    for (std::size_t i = 0; i < 3; ++i)
        svg.polygon(view(corners_of(whole.boxes[i])),
                    {.stroke = {}, .fill = Ink::orange, .opacity = 0.14});
    for (std::size_t i = 0; i < 3; ++i)
        svg.polygon(view(corners_of(clipped.boxes[i])),
                    {.stroke = Ink::blue, .fill = Ink::sky, .opacity = 0.3});
    svg.polygon(view(corners_of(cell)), {.stroke = Ink::ink}, "cell");
    const Vector2 rim(0.5f);
    for (const Segment& segment : segments())
        for (const bool within : {false, true}) {
            const Aabb2 shown = within ? cell : Aabb2{cell.min - rim, cell.max + rim};
            const Ray2 along{segment.a, segment.b - segment.a, 0.0f, 1.0f};
            const RayPart part = *part_in(shown, KdRay<2>(along), RayPart::all_of(along));
            const Double2 from(along.origin), way(along.direction);
            draw_segment(svg, view, from + part.enter * way, from + part.leave * way,
                         {.stroke = {}, .fill = within ? Ink::ink : Ink::faint});
        }
}

/// Costs from `least` on, over the cell.
struct Plot {
    double bottom = 546, unit = 50, least = 4;
    Point2 operator()(double x, double cost) const {
        return at(left + scale * x, bottom - unit * (cost - least));
    }
};

void draw_axes(Svg& svg, const Plot& plot, double leaf) {
    const double right = static_cast<double>(cell.max.x);
    svg.line(plot(0, plot.least), plot(right, plot.least), {.stroke = Ink::quiet, .arrow = true});
    svg.line(plot(0, plot.least), plot(0, leaf + 1.9), {.stroke = Ink::quiet, .arrow = true});
    for (double cost = plot.least; cost <= leaf + 1; ++cost)
        svg.text(moved(plot(0, cost), -8, 6), svg_number(cost),
                 {.anchor = Anchor::end, .size = 17});
    svg.line(plot(0, leaf), plot(right, leaf), {.stroke = Ink::quiet, .dashed = true});
    svg.text(moved(plot(0, leaf), 8, 22), "no plane: a leaf",
             {.anchor = Anchor::start, .ink = Ink::quiet, .size = 17});
    svg.text(moved(plot(right, plot.least), 0, 24), "*x*", {.size = 18});
    svg.text(moved(plot(0, leaf + 1.9), 12, 8), "cost", {.anchor = Anchor::start, .size = 17});
}

void draw_curve(Svg& svg, const Plot& plot, const Sweep& sweep, Ink ink, bool dashed) {
    for (const auto& [from, to] : sweep.pieces())
        svg.line(plot(from.x, from.y), plot(to.x, to.y), {.stroke = ink, .dashed = dashed});
    for (const SahCandidate& candidate : sweep.candidates)
        svg.circle(plot(static_cast<double>(candidate.split.position), candidate.cost), 4,
                   {.stroke = {}, .fill = ink});
    const Point2 best = plot(static_cast<double>(sweep.best.split.position), sweep.best.cost);
    svg.circle(best, 9, {.stroke = ink});
    svg.text(moved(best, -14, 20), fmt::format("{:.1f}", sweep.best.cost),
             {.anchor = Anchor::end, .ink = ink, .size = 18, .halo = true});
}

}  // namespace

Svg fig_04_05(const Options&) {
    std::vector<Aabb2> boxes, parts;
    for (const Segment& segment : segments()) {
        boxes.push_back(box_in_cell(segment));
        parts.push_back(clipped_bounds<2>(segment, boxes.back()));
    }
    const Sweep whole(boxes), clipped(parts);
    Svg svg(
        "A cell with seven segments, and below it the cost of planes across it, with boxes of "
        "whole segments and with boxes of their parts in the cell",
        660, 578);
    draw_cell(svg, whole, clipped);
    const Plot plot;
    draw_axes(svg, plot, Sweep::costs().intersection * static_cast<double>(boxes.size()));
    draw_curve(svg, plot, whole, Ink::vermillion, true);
    draw_curve(svg, plot, clipped, Ink::blue, false);
    return svg;
}

}  // namespace space::ch04
