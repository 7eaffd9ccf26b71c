#include "chapters/ch12_comparison/figures/chart_parts.hpp"
#include "chapters/ch12_comparison/figures/comparison_charts.hpp"
#include "chapters/ch12_comparison/measured/break_even.hpp"
#include "common/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace space::ch12 {
namespace {

/// Which structure is the cheapest in most scenes, from a number of rays on.
struct RaysRange {
    std::string structure;
    double from;
};

std::vector<RaysRange> most_often_cheapest(std::span<const Block> shown) {
    std::vector<RaysRange> ranges;
    for (int tenth = 0; tenth <= 100; ++tenth) {
        const double rays = std::pow(10.0, 0.1 * tenth);
        std::map<std::string, int> wins;
        for (const Block block : shown) {
            const std::vector<CostLine> lines = cost_lines(block, false);
            if (!lines.empty()) ++wins[lines[cheapest(lines, rays)].name];
        }
        const auto most =
            std::ranges::max_element(wins, {}, [](const auto& named) { return named.second; });
        if (most == wins.end()) continue;
        // A lead that is lost again before the rays are three times as many is none.
        const bool is_new = ranges.empty() || ranges.back().structure != most->first;
        if (is_new && ranges.size() > 1 && rays < 3.0 * ranges.back().from) ranges.pop_back();
        if (ranges.empty() || ranges.back().structure != most->first)
            ranges.push_back({most->first, rays});
    }
    return ranges;
}

/// A structure's bytes a triangle, on the median of the scenes.
double usual_bytes(std::span<const Block> shown, std::string_view structure) {
    std::vector<double> bytes;
    for (const Block block : shown)
        if (const ComparedRow* row = find(block, structure))
            bytes.push_back(double(row->bytes) / double(row->triangles));
    return median(bytes);
}

/// 316 -> "300": with one digit.
std::string round_count(double rays) {
    const double decade = std::pow(10.0, std::floor(std::log10(rays) + 1e-9));
    return tick_text(std::round(rays / decade) * decade, 1e10);
}

/// A question in its box, and beside it what to take where the answer is yes.
struct Decision {
    std::string question, hint;
    std::vector<std::string> answers;
};

std::vector<Decision> decisions(std::span<const Block> shown) {
    const std::vector<RaysRange> ranges = most_often_cheapest(shown);
    Decision few{"Are rays few?", "build + rays", {}};
    double many = 0.0;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const double to = i + 1 < ranges.size() ? ranges[i + 1].from : infinity;
        if (to <= 1e7)
            few.answers.push_back(
                fmt::format("up to {}: {}", round_count(to), ranges[i].structure));
        if (ranges[i].structure == "fast-hq") many = ranges[i].from;
    }
    if (few.answers.empty()) few.answers.push_back("none, or a Morton tree");
    const std::string from =
        many > 0.0 ? fmt::format("from {} rays on: fast-hq", round_count(many)) : "fast-hq";
    return {few,
            {"Does it move?", "every frame", {"refit the boxes,", "a new Morton tree at times"}},
            {"Are there copies?", "of whole objects", {"two levels: bvh-instanced"}},
            {"Is memory short?",
             fmt::format("{:.0f} bytes a triangle", usual_bytes(shown, "fast")),
             {fmt::format("fast-compressed: {:.0f} bytes", usual_bytes(shown, "fast-compressed"))}},
            {"Are they long?", "or rays very many", {"spatial splits:", from}}};
}

constexpr double decision_left = 8, decision_width = 232, decision_height = 62, answer_left = 318,
                 answer_width = 314, answer_line = 24;

}  // namespace

Chart decision_chart(const Comparison& comparison) {
    const std::vector<Block> shown = shown_blocks(comparison);
    const std::vector<Decision> all = decisions(shown);
    Chart chart{.title =
                    "Which structure? Five questions, from above to below: at the first yes "
                    "take what stands beside it",
                .x_label = "from so many rays",
                .y_label = "in the order of rays",
                .kind = ChartKind::points,
                .series = {}};
    for (const RaysRange& range : most_often_cheapest(shown))
        chart.series.push_back({.name = range.structure, .x = {range.from}, .y = {1.0}});
    double height = 8;
    for (const Decision& decision : all)
        height +=
            38 + std::max(decision_height, 14 + answer_line * double(decision.answers.size()));
    Svg& svg = chart.drawing.emplace(chart.title, 640, height + decision_height + 8);
    double y = 8;
    for (const Decision& decision : all) {
        const double high =
            std::max(decision_height, 14 + answer_line * double(decision.answers.size()));
        const double middle = y + 0.5 * high;
        svg.rect(at(decision_left, middle - 0.5 * decision_height),
                 {decision_width, decision_height},
                 {.stroke = Ink::blue, .fill = Ink::blue, .opacity = 0.12});
        svg.text(at(decision_left + 0.5 * decision_width, middle - 4), decision.question,
                 {.size = 19, .bold = true});
        svg.text(at(decision_left + 0.5 * decision_width, middle + 20), decision.hint,
                 {.ink = Ink::quiet, .size = 16});
        svg.line(at(decision_left + decision_width, middle), at(answer_left - 3, middle),
                 {.arrow = true});
        svg.text(at(0.5 * (decision_left + decision_width + answer_left), middle - 8), "yes",
                 {.size = 16});
        svg.rect(at(answer_left, y), Vector2(glm::dvec2(answer_width, high)),
                 {.stroke = Ink::green, .fill = Ink::green, .opacity = 0.12});
        const double first = middle - 0.5 * answer_line * double(decision.answers.size()) + 18;
        for (std::size_t i = 0; i < decision.answers.size(); ++i)
            svg.text(at(answer_left + 10, first + answer_line * double(i)), decision.answers[i],
                     {.anchor = Anchor::start, .size = 17});
        const double next_high = y + high + 38;
        svg.line(at(decision_left + 0.5 * decision_width, middle + 0.5 * decision_height),
                 at(decision_left + 0.5 * decision_width, next_high - 3), {.arrow = true});
        svg.text(at(decision_left + 0.5 * decision_width + 10, next_high - 15), "no",
                 {.anchor = Anchor::start, .size = 16});
        y = next_high;
    }
    svg.rect(at(decision_left, y),
             Vector2(glm::dvec2(answer_left + answer_width - decision_left, decision_height)),
             {.stroke = Ink::green, .fill = Ink::green, .opacity = 0.12});
    svg.text(at(decision_left + 16, y + 26), "fast: a binned hierarchy with eight children",
             {.anchor = Anchor::start, .size = 17});
    svg.text(at(decision_left + 16, y + 50), "(bvh-binned, where the code is to be understood)",
             {.anchor = Anchor::start, .ink = Ink::quiet, .size = 17});
    return chart;
}

}  // namespace space::ch12
