#include "chapters/ch02_intersection_tests/figures.hpp"
#include "chapters/ch02_intersection_tests/figures/bar.hpp"
#include "chapters/ch02_intersection_tests/measured/chunks.hpp"
#include "chapters/ch02_intersection_tests/measured/data.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace space::ch02 {
namespace {

/// "10^-3" as "10⁻³".
std::string with_powers(const std::string& text) {
    constexpr const char* raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const std::size_t caret = text.find('^');
    std::string result = text.substr(0, caret);
    for (std::size_t i = std::min(caret, text.size() - 1) + 1; i < text.size(); ++i)
        result += text[i] == '-' ? "⁻" : raised[text[i] - '0'];
    return result;
}

/// A share of all, never rounded to all.
std::string percent(std::uint64_t part, std::uint64_t all) {
    if (part < all && 10'000 * (all - part) < all) return "> 99.99 %";
    return fmt::format("{:.{}f} %", 100.0 * double(part) / double(all), part == all ? 0 : 2);
}

constexpr int row = 34, head = 262;

/// Where the computed value of one volume may lie.
void draw_number_line(Svg& svg) {
    constexpr double y = 96, zero = 210, size = 470, bound = 42;
    bar(svg, 20, zero - bound, y - 14, 28, Ink::faint);
    bar(svg, zero - bound, zero + bound, y - 14, 28, Ink::orange, 0.8);
    bar(svg, zero + bound, size - bound, y - 14, 28, Ink::green, 0.8);
    bar(svg, size - bound, size + bound, y - 14, 28, Ink::orange, 0.8);
    bar(svg, size + bound, 606, y - 14, 28, Ink::faint);
    svg.line({20, y}, {626, y}, {.arrow = true});
    const auto mark = [&](double x, const char* label) {
        svg.line(at(x, y - 22), at(x, y + 22));
        svg.text(at(x, y + 44), label, {});
    };
    mark(zero, "0");
    mark(size, "|*det*|");
    const auto name = [&](double x, const char* label) {
        svg.text(at(x, y - 30), label, {.bold = true});
    };
    name(92, "miss");
    name(zero, "unsure");
    name(0.5 * (zero + size), "inside");
    name(size, "unsure");
    name(572, "miss");
    const auto reach = [&](double x) {
        svg.line(at(x, y + 56), at(x - bound, y + 56), {.arrow = true});
        svg.line(at(x, y + 56), at(x + bound, y + 56), {.arrow = true});
        svg.text(at(x, y + 80), "± bound", {});
    };
    reach(zero);
    reach(size);
    svg.text({320, 30}, "a computed volume (the bound drawn far too wide)", {.ink = Ink::quiet});
}

/// Who decides about as many rays as the text speaks of, which are the same.
StageCounts stages_of(const TriangleInput& input, std::uint64_t pairs, const Options& options) {
    const auto count = [&](Pcg32& random, std::uint64_t rays) {
        StageCounts stages;
        for (std::uint64_t i = 0; i < rays; ++i) {
            const auto [ray, triangle] = make_pair(input, random);
            FilteredExact::intersect(ray, triangle, stages);
        }
        return stages;
    };
    StageCounts sum;
    for (const auto& part :
         count_by_chunks<StageCounts>(pairs, options.seed, options.threads, count))
        for (std::size_t stage = 0; stage < 3; ++stage) sum.count[stage] += part.count[stage];
    return sum;
}

void draw_who_decides(Svg& svg, const Options& options) {
    constexpr std::uint64_t pairs = 1'000'000;
    constexpr double left = 176, right = 520;
    svg.text({320, 226}, fmt::format("who decides, of {} rays each", with_commas(pairs)),
             {.ink = Ink::quiet});
    const std::array<Ink, 3> inks{Ink::green, Ink::orange, Ink::purple};
    double top = head - 16;
    for (const TriangleInput& input : triangle_inputs()) {
        const StageCounts stages = stages_of(input, pairs, options);
        svg.text(at(left - 12, top + 18), with_powers(input.name),
                 {.anchor = Anchor::end, .size = 17});
        double x = left;
        for (std::size_t stage = 0; stage < 3; ++stage) {
            const double next = x + (right - left) * double(stages.count[stage]) / double(pairs);
            if (stages.count[stage]) bar(svg, x, std::max(next, x + 1), top, 24, inks[stage], 0.85);
            x = next;
        }
        svg.text(at(right + 12, top + 18), percent(stages.count[0], pairs),
                 {.anchor = Anchor::start, .size = 17});
        top += row;
    }
    const std::array<std::tuple<float, Ink, const char*>, 3> legend{
        {{60, inks[0], "filter in double"},
         {254, inks[1], "128-bit integers"},
         {450, inks[2], "expansions"}}};
    for (const auto& [x, ink, label] : legend) {
        svg.rect(at(x, top + 14), at(20, 20), {.stroke = Ink::quiet, .fill = ink, .opacity = 0.85});
        svg.text(at(x + 28, top + 30), label, {.anchor = Anchor::start, .size = 17});
    }
}

}  // namespace

Svg fig_02_05(const Options& options) {
    Svg svg(
        "The filter's number line, and the share of the rays that each of the three stages decides",
        640, head + row * static_cast<double>(triangle_inputs().size()) + 54);

    draw_number_line(svg);
    draw_who_decides(svg, options);
    return svg;
}

}  // namespace space::ch02
