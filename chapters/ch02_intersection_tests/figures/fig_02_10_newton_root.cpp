#include "chapters/ch02_intersection_tests/figures.hpp"
#include "chapters/ch02_intersection_tests/square_roots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace space::ch02 {
namespace {

constexpr double left = 62, right = 540, top = 296, decade = 34;  // top: of the errors' part

double x_of(double a) {  // from 1 to 4
    return left + (right - left) * 0.5 * std::log2(a);
}

double y_of_error(double error) {
    return top - decade * std::log10(std::max(error, 1e-8)) - decade;
}

void draw_bits_as_logarithm(Svg& svg) {
    constexpr double low = 222, unit = 92;
    const auto y_of = [](double log) { return low - unit * log; };
    svg.text({left, 24}, "the float's bits / 2²³ − 127",
             {.anchor = Anchor::start, .ink = Ink::vermillion});
    for (int i = 0; i <= 2; ++i) {
        svg.line(at(left, y_of(i)), at(right, y_of(i)), {.stroke = Ink::faint});
        svg.line(at(x_of(std::ldexp(1.0, i)), y_of(0)), at(x_of(std::ldexp(1.0, i)), y_of(2)),
                 {.stroke = Ink::faint});
        svg.text(at(left - 12, y_of(i) + 6), fmt::format("{}", i), {.anchor = Anchor::end});
        svg.text(at(x_of(std::ldexp(1.0, i)), y_of(0) + 26), fmt::format("{}", 1 << i), {});
    }
    svg.text(at(x_of(2.8), y_of(0) + 26), "*a*", {.size = 20});
    std::vector<Point2> bits;
    for (int i = 0; i <= 192; ++i) {
        const float a = static_cast<float>(std::exp2(i / 96.0));
        bits.push_back(at(
            x_of(a),
            y_of(std::ldexp(static_cast<double>(std::bit_cast<std::uint32_t>(a)), -23) - 127.0)));
    }
    svg.line(at(x_of(1), y_of(0)), at(x_of(4), y_of(2)), {.stroke = Ink::blue});
    svg.polyline(bits, {.stroke = Ink::vermillion});
    svg.text(at(x_of(1.9) - 34, y_of(1) - 22), "log_2 *a*", {.ink = Ink::blue, .size = 20});
}

void draw_axes_of_errors(Svg& svg) {
    svg.text({left, top - 12}, "relative error of the root", {.anchor = Anchor::start});
    constexpr const char* powers[] = {"10⁻¹", "10⁻²", "10⁻³", "10⁻⁴",
                                      "10⁻⁵", "10⁻⁶", "10⁻⁷", "10⁻⁸"};
    for (int i = 0; i < 8; ++i) {
        const double y = top + decade * i;
        svg.line(at(left, y), at(right, y), {.stroke = Ink::faint});
        if (i % 2 == 0 || i == 7)
            svg.text(at(left - 8, y + 6), powers[i], {.anchor = Anchor::end, .size = 17});
    }
    for (int i = 0; i <= 2; ++i) {
        svg.line(at(x_of(std::ldexp(1.0, i)), top), at(x_of(std::ldexp(1.0, i)), top + 7 * decade),
                 {.stroke = Ink::faint});
        svg.text(at(x_of(std::ldexp(1.0, i)), top + 7 * decade + 28), fmt::format("{}", 1 << i),
                 {});
    }
    svg.text(at(x_of(2.8), top + 7 * decade + 28), "*a*", {.size = 20});
}

/// The worst error of each window: rounding is noise, and noise is no line.
void draw_error(Svg& svg, float (*root)(float), Ink ink, const char* label, double lowered = 6) {
    constexpr int windows = 240, samples = 32;
    std::vector<Point2> line;
    double last = 0.0;
    for (int window = 0; window < windows; ++window) {
        double worst = 0.0;
        for (int i = 0; i < samples; ++i) {
            const auto a =
                static_cast<float>(std::exp2(2.0 * (window + (i + 0.5) / samples) / windows));
            worst = std::max(worst, std::abs(root(a) / std::sqrt(double{a}) - 1.0));
        }
        line.push_back(at(x_of(std::exp2(2.0 * (window + 0.5) / windows)), y_of_error(worst)));
        last = worst;
    }
    svg.polyline(line, {.stroke = ink});
    svg.text(at(right + 10, y_of_error(last) + lowered), label,
             {.anchor = Anchor::start, .ink = ink == Ink::orange ? Ink::ink : ink, .size = 17});
}

}  // namespace

Svg fig_02_10(const Options&) {
    Svg svg(
        "A float's bits are nearly its logarithm; the error of the square root after each "
        "round of Newton's method",
        640, 612);
    draw_bits_as_logarithm(svg);
    draw_axes_of_errors(svg);
    draw_error(svg, newton_root<0>, Ink::vermillion, "guess");
    draw_error(svg, newton_root<1>, Ink::orange, "1 round");
    draw_error(svg, newton_root<2>, Ink::blue, "2 rounds", -4);
    draw_error(svg, newton_root<3>, Ink::green, "3 rounds", 16);
    return svg;
}

}  // namespace space::ch02
