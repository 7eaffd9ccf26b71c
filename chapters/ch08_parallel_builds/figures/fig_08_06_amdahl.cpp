// Amdahl's law, and graph 1 of BvhThesis13 in it: the queue's gains on one, two and four cores.

#include "chapters/ch08_parallel_builds/amdahl.hpp"
#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/measured/build_data.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace space::ch08 {
namespace {

constexpr double left = 56, bottom = 372, octave_x = 62, octave_y = 66;

/// Both axes are logarithmic.
Point2 place(double cores, double gain) {
    return at(left + octave_x * std::log2(cores), bottom - octave_y * std::log2(gain));
}

void draw_axes(Svg& svg) {
    for (unsigned octave = 0; octave <= 8; ++octave) {
        const double cores = std::exp2(octave);
        svg.line(place(cores, 1.0), place(cores, 32.0), {.stroke = Ink::faint});
        svg.text(moved(place(cores, 1.0), 0, 24), svg_number(cores), {});
    }
    for (unsigned octave = 0; octave <= 5; ++octave) {
        const double gain = std::exp2(octave);
        svg.line(place(1.0, gain), place(256.0, gain), {.stroke = Ink::faint});
        svg.text(moved(place(1.0, gain), -10, 6), svg_number(gain), {.anchor = Anchor::end});
    }
    svg.text(moved(place(16.0, 1.0), 0, 50), "cores", {});
    svg.text(at(10, 22), "times faster than one core", {.anchor = Anchor::start});
}

void draw_law(Svg& svg, double share, Ink ink) {
    std::vector<Point2> points;
    for (unsigned quarter = 0; quarter <= 32; ++quarter) {
        const double cores = std::exp2(quarter / 4.0);
        points.push_back(place(cores, amdahl_speedup(share, cores)));
    }
    svg.polyline(points, {.stroke = ink});
    svg.text(moved(points.back(), 8, 6), fmt::format("{} %", svg_number(100.0 * share)),
             {.anchor = Anchor::start, .ink = ink});
}

}  // namespace

Svg fig_08_06(const Options&) {
    Svg svg("Amdahl's law for four serial shares, and the published gains of the queue", 660, 432);
    draw_axes(svg);
    std::vector<Point2> even;
    for (const double cores : {1.0, 32.0}) even.push_back(place(cores, cores));
    svg.polyline(even, {.stroke = Ink::quiet, .dashed = true});
    for (const auto& [share, ink] : {std::pair{0.05, Ink::green}, std::pair{0.15, Ink::blue},
                                     std::pair{0.3, Ink::purple}, std::pair{0.5, Ink::vermillion}})
        draw_law(svg, share, ink);
    constexpr std::size_t queue = 2;
    for (const PublishedBuild& row : published_builds())
        svg.circle(place(row.threads, row.gain(queue)), 5, {.stroke = {}, .fill = Ink::ink});
    return svg;
}

}  // namespace space::ch08
