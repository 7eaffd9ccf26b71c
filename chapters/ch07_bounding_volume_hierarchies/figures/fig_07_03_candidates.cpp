// What cuts of a node across one axis cost: all of them, and those between bins.

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace space::ch07 {
namespace {

constexpr double scale = 24, left = 36;
constexpr std::size_t bins = 6;
constexpr BvhCosts costs{1.0, 1.0};

/// Many small ones to the right, a few long ones elsewhere.
std::vector<Segment> crowded_segments() {
    std::vector<Segment> all{{{0.5f, 1.0f}, {5.5f, 2.25f}},   {{1.0f, 6.5f}, {6.75f, 4.5f}},
                             {{4.0f, 3.0f}, {9.5f, 6.75f}},   {{8.25f, 0.75f}, {12.0f, 1.5f}},
                             {{10.5f, 4.0f}, {14.25f, 6.0f}}, {{15.5f, 1.5f}, {18.25f, 3.25f}},
                             {{18.5f, 0.5f}, {25.5f, 1.25f}}};
    Pcg32 random(5);
    while (all.size() < 24) {
        const Point2 middle = random_point(random, Aabb2{{17.75f, 2.5f}, {23.5f, 6.5f}});
        const auto angle = static_cast<double>(random.uniform(0.0f, 3.14f));
        const Vector2 way(0.42 * Double2(std::cos(angle), std::sin(angle)));
        const bool near = std::ranges::any_of(all, [&](const Segment& other) {
            return glm::length(0.5f * (other.a + other.b) - middle) < 0.9f;
        });
        if (!near) all.push_back({middle - way, middle + way});
    }
    return all;
}

double middle_of(const BvhReference<2>& reference) {
    return static_cast<double>(reference.box.centroid().x);
}

/// A cut before the middle at `until`; all places from `from` on make the same cut.
struct Cut {
    double from, until, cost;
};

/// Every cut across x, in the order of the middles.
std::vector<Cut> all_cuts(std::vector<BvhReference<2>> references) {
    std::ranges::sort(references, {}, middle_of);
    const HitChance<2> chance(box_around<2>(references));
    std::vector<Cut> all;
    for (std::size_t i = 1; i < references.size(); ++i) {
        const auto [count, first, second] = cut_after<2>(i, references);
        const double tests =
            chance(first) * double(count) + chance(second) * double(references.size() - count);
        all.push_back({middle_of(references[i - 1]), middle_of(references[i]),
                       costs.traversal + costs.intersection * tests});
    }
    return all;
}

struct Plot {
    double bottom = 470, unit = 13, least = 10;
    Point2 operator()(double x, double cost) const {
        return at(left + scale * x, bottom - unit * (cost - least));
    }
};

/// The places between bins are those where bin_of changes.
std::vector<double> places_between(const std::vector<BvhReference<2>>& references) {
    const Aabb2 middles = box_around_centroids<2>(references);
    std::vector<double> places;
    for (std::size_t i = 1; i < bins; ++i)
        places.push_back(double{middles.min.x} +
                         double(i) / bins * (double{middles.max.x} - double{middles.min.x}));
    return places;
}

void draw_node(Svg& svg, const std::vector<BvhReference<2>>& references,
               const std::vector<Segment>& all) {
    const PlaneView view{.corner = {left, 16}, .scale = scale, .size = 7.5};
    for (const double place : places_between(references))
        svg.line(view({place, 7.5}), view({place, 0}), {.stroke = Ink::sky, .dashed = true});
    for (const BvhReference<2>& reference : references)
        svg.polygon(view(corners_of(reference.box)), {.stroke = Ink::faint});
    draw_box(svg, view, box_around<2>(references), 3, {.stroke = Ink::quiet});
    for (const Segment& segment : all)
        draw_segment(svg, view, Double2(segment.a), Double2(segment.b),
                     {.stroke = {}, .fill = Ink::ink});
    for (const BvhReference<2>& reference : references)
        svg.circle(view(Double2(reference.box.centroid())), 4,
                   {.stroke = Ink::paper, .fill = Ink::vermillion});
}

void draw_axes(Svg& svg, const Plot& plot, double leaf) {
    svg.line(plot(0, plot.least), plot(26, plot.least), {.stroke = Ink::quiet, .arrow = true});
    svg.line(plot(0, plot.least), plot(0, leaf + 2.4), {.stroke = Ink::quiet, .arrow = true});
    for (double cost = plot.least; cost <= leaf; cost += 4)
        svg.text(moved(plot(0, cost), -8, 6), svg_number(cost),
                 {.anchor = Anchor::end, .size = 17});
    svg.line(plot(0, leaf), plot(26, leaf), {.stroke = Ink::quiet, .dashed = true});
    svg.text(moved(plot(13, leaf), 0, 22), "no cut: a leaf", {.ink = Ink::quiet, .size = 17});
    svg.text(moved(plot(26, plot.least), -4, 24), "*x*", {.size = 18});
    svg.text(moved(plot(0, leaf + 2.4), 12, 8), "cost", {.anchor = Anchor::start, .size = 17});
}

void draw_best(Svg& svg, const Point2& place, double cost, Ink ink, Anchor anchor) {
    svg.circle(place, 9, {.stroke = ink});
    svg.text(moved(place, anchor == Anchor::end ? -10 : 10, 26), fmt::format("{:.2f}", cost),
             {.anchor = anchor, .ink = ink, .size = 18, .halo = true});
}

}  // namespace

Svg fig_07_03(const Options&) {
    const std::vector<Segment> all = crowded_segments();
    std::vector<BvhReference<2>> references = boxed<2>(all);
    const std::vector<Cut> cuts = all_cuts(references);
    Svg svg(
        "A node of segments with the middles of their boxes, and below it what a cut there costs",
        676, 504);
    draw_node(svg, references, all);
    const Plot plot;
    draw_axes(svg, plot, costs.intersection * double(all.size()));
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        const auto& [from, until, cost] = cuts[i];
        svg.line(plot(from, cost), plot(until, cost), {.stroke = Ink::vermillion});
        if (i > 0)
            svg.line(plot(from, cuts[i - 1].cost), plot(from, cost), {.stroke = Ink::vermillion});
    }
    const auto cut_at = [&](double place) {
        return *std::ranges::find_if(cuts, [&](const Cut& cut) { return place <= cut.until; });
    };
    for (const double place : places_between(references))
        svg.circle(plot(place, cut_at(place).cost), 5, {.stroke = Ink::paper, .fill = Ink::blue});

    const Cut least = *std::ranges::min_element(cuts, {}, &Cut::cost);
    draw_best(svg, plot(0.5 * (least.from + least.until), least.cost), least.cost, Ink::vermillion,
              Anchor::start);
    BvhBins<2> binned;
    binned.fill(references, bins);
    const auto best = binned.best(box_around<2>(references), references.size());
    const double between = places_between(references)[best.bin - 1];
    draw_best(svg, plot(between, costs.traversal + costs.intersection * best.tests),
              costs.traversal + costs.intersection * best.tests, Ink::blue, Anchor::end);
    return svg;
}

}  // namespace space::ch07
