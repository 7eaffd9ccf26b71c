// The samples of one pixel on the square, by each pattern.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace space::ch11 {
namespace {

constexpr std::uint32_t pattern_samples = 64, pattern_cells = 8;  ///< cells on each side

std::vector<Double2> samples_by(SamplePattern pattern) {
    Sampler sampler(pattern, pattern_samples, 1);
    std::vector<Double2> samples;
    for (std::uint32_t i = 0; i < pattern_samples; ++i) {
        sampler.start(0, i);
        samples.push_back(sampler.next_pair());
    }
    return samples;
}

/// How many of columns x rows equal boxes hold none.
std::size_t empty_boxes(const std::vector<Double2>& samples, std::size_t columns,
                        std::size_t rows) {
    std::vector<bool> is_met(columns * rows);
    for (const Double2& p : samples)
        is_met[static_cast<std::size_t>(p.y * static_cast<double>(rows)) * columns +
               static_cast<std::size_t>(p.x * static_cast<double>(columns))] = true;
    return static_cast<std::size_t>(std::ranges::count(is_met, false));
}

}  // namespace

Svg fig_11_05(const Options&) {
    constexpr double side = 204, gap = 18, left = 8, top = 40;
    constexpr std::array<SamplePattern, 3> patterns{
        SamplePattern::independent, SamplePattern::stratified, SamplePattern::sobol};
    const std::array<std::string, 3> names{"independent", "stratified", "scrambled net"};
    Svg svg("64 samples on a square: independent, one in each cell, and a scrambled net", 664, 310);
    for (std::size_t i = 0; i < patterns.size(); ++i) {
        const std::vector<Double2> samples = samples_by(patterns[i]);
        const Point2 corner = at(left + (side + gap) * static_cast<double>(i), top);
        svg.text(moved(corner, side / 2, -14), names[i], {.size = 19, .bold = true});
        for (std::uint32_t line = 1; line < pattern_cells; ++line) {
            const double place = side * line / pattern_cells;
            svg.line(moved(corner, place, 0), moved(corner, place, side), {.stroke = Ink::faint});
            svg.line(moved(corner, 0, place), moved(corner, side, place), {.stroke = Ink::faint});
        }
        svg.rect(corner, at(side, side), {.stroke = Ink::quiet});
        for (const Double2& p : samples)
            svg.circle(moved(corner, side * p.x, side * (1.0 - p.y)), 3.5,
                       {.stroke = {}, .fill = Ink::blue});
        const auto row = [&](double y, std::size_t empty, const char* what) {
            svg.text(moved(corner, side / 2, side + y), fmt::format("{} {} empty", empty, what),
                     {.size = 17});
        };
        row(24, empty_boxes(samples, pattern_cells, pattern_cells), "cells");
        row(48, empty_boxes(samples, pattern_samples, 1), "columns");
    }
    return svg;
}

}  // namespace space::ch11
