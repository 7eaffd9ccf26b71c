// Morton codes: how bits of a place become a code, and the curve of all cells in the order of
// codes.

#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures/plane_cells.hpp"
#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace space::ch06 {
namespace {

constexpr double top = 40;

std::string bits_of(std::uint64_t number, int count) {
    return fmt::format("{:0{}b}", number, count);
}

/// Four bits in a cell: those of y in one colour, those of x in another.
void draw_codes(Svg& svg, double left, double side) {
    constexpr std::uint32_t depth = 2, cells = 1u << depth;
    const PlaneView view{.corner = {left, top}, .scale = side / cells, .size = cells};
    for (std::uint64_t code = 0; code < cells * cells; ++code) {
        const OrthtreeCell<2> cell = cell_of_code<2>(code, depth);
        const Double2 low(cell.place[0], cell.place[1]);
        svg.polygon(view(corners_of({low, low + 1.0})), {.stroke = Ink::faint});
        const Point2 middle = view(low + Double2(0.5, 0.5));
        svg.text(moved(middle, 0, -3), std::to_string(code), {.size = 20});
        const std::string bits = bits_of(code, 2 * depth);
        for (std::size_t i = 0; i < bits.size(); ++i)
            svg.text(moved(middle, 10.0 * double(i) - 15.0, 18), bits.substr(i, 1),
                     {.ink = i % 2 == 0 ? Ink::vermillion : Ink::blue, .size = 17, .bold = true});
    }
    for (std::uint32_t i = 0; i < cells; ++i) {
        svg.text(moved(view({i + 0.5, 0.0}), 0, 20), bits_of(i, depth),
                 {.ink = Ink::blue, .size = 17, .bold = true});
        svg.text(moved(view({0.0, i + 0.5}), -16, 6), bits_of(i, depth),
                 {.ink = Ink::vermillion, .size = 17, .bold = true});
    }
    svg.text(moved(view({0.5 * cells, 0.0}), 0, 42), "*x*", {.ink = Ink::blue});
    svg.text(moved(view({0.0, 0.5 * cells}), -40, 6), "*y*", {.ink = Ink::vermillion});
    svg.line(view({0.5 * cells, 0.0}), view({0.5 * cells, double(cells)}), {.stroke = Ink::quiet});
    svg.line(view({0.0, 0.5 * cells}), view({double(cells), 0.5 * cells}), {.stroke = Ink::quiet});
    svg.text(at(left + 0.5 * side, 24), "bits by turns", {.bold = true});
}

/// A step of the curve: from one code to the next.
struct Step {
    Double2 from, to;
    double length() const { return glm::length(to - from); }
};
std::vector<Step> curve(std::uint32_t depth) {
    std::vector<Step> steps;
    const auto middle = [&](std::uint64_t code) {
        const auto place = cell_of_code<2>(code, depth).place;
        return Double2(place[0], place[1]) + 0.5;
    };
    for (std::uint64_t code = 0; code + 1 < std::uint64_t{1} << (2 * depth); ++code)
        steps.push_back({middle(code), middle(code + 1)});
    return steps;
}

/// To a neighbour over a side, over a corner, and farther: the longest of all stand out.
Ink ink_of(const Step& step, double longest) {
    if (step.length() == longest) return Ink::vermillion;
    return step.length() > 1.5 ? Ink::orange : Ink::blue;
}

void draw_curve(Svg& svg, double left, double side) {
    constexpr std::uint32_t depth = 3, cells = 1u << depth;
    const PlaneView view{.corner = {left, top}, .scale = side / cells, .size = cells};
    const std::vector<Step> steps = curve(depth);
    double longest = 0;
    std::size_t jumps = 0;
    for (const Step& step : steps) {
        longest = std::max(longest, step.length());
        jumps += step.length() > 1.5;
    }
    svg.rect(at(left, top), at(side, side), {.stroke = Ink::faint});
    for (int i = 1; i < 4; ++i) {
        svg.line(view({2.0 * i, 0.0}), view({2.0 * i, 8.0}), {.stroke = Ink::faint});
        svg.line(view({0.0, 2.0 * i}), view({8.0, 2.0 * i}), {.stroke = Ink::faint});
    }
    svg.line(view({4.0, 0.0}), view({4.0, 8.0}), {.stroke = Ink::quiet});
    svg.line(view({0.0, 4.0}), view({8.0, 4.0}), {.stroke = Ink::quiet});
    for (const Ink ink : {Ink::orange, Ink::blue, Ink::vermillion})
        for (const Step& step : steps)
            if (ink_of(step, longest) == ink)
                svg.line(view(step.from), view(step.to), {.stroke = ink});
    for (std::uint64_t code = 0; code < cells * cells; ++code) {
        const auto place = cell_of_code<2>(code, depth).place;
        svg.circle(view(Double2(place[0], place[1]) + 0.5), 3, {.stroke = {}, .fill = Ink::ink});
    }
    const auto label = [&](std::uint64_t code, double x, double y) {
        const auto place = cell_of_code<2>(code, depth).place;
        svg.text(moved(view(Double2(place[0], place[1]) + 0.5), x, y), std::to_string(code),
                 {.size = 17, .halo = true});
    };
    label(0, -4, 22);
    label(15, -2, -8);
    label(16, 4, 22);
    label(31, 2, -8);
    label(32, -6, -8);
    label(63, 2, -8);
    svg.text(at(left + 0.5 * side, 24), "the curve", {.bold = true});
    svg.text(at(left + 0.5 * side, top + side + 24),
             fmt::format("{} of {} steps are jumps,", jumps, steps.size()), {.size = 17});
    svg.text(at(left + 0.5 * side, top + side + 48),
             fmt::format("the longest over {:.2f} cells", longest), {.size = 17});
}

}  // namespace

Svg fig_06_09(const Options&) {
    Svg svg(
        "Morton codes of 16 cells, and the curve through 64 cells in their order with its jumps",
        676, 420);
    draw_codes(svg, 56, 264);
    draw_curve(svg, 348, 320);
    return svg;
}

}  // namespace space::ch06
