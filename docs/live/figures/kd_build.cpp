#include "chapters/ch04_kd_trees/figures/drawn_build.hpp"
#include "common/scene.hpp"
#include "docs/live/live.hpp"
#include "docs/live/plane_handles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace space::live {
namespace {

using namespace std::string_view_literals;
using Rule = KdTreeConfig::Rule;
using Straddlers = KdTreeConfig::Straddlers;

constexpr std::array rules{"the thesis's planes"sv, "in the middle"sv, "at the median"sv,
                           "surface area heuristic"sv};
constexpr std::array first_planes{"as the rule has it"sv, "across x, by hand"sv,
                                  "across y, by hand"sv};
constexpr std::array straddlers_named{"where their parts are"sv, "where their boxes are"sv};

/// Planes are taken as they are planned, as long as they part the cells that they come to.
ch04::Story story_of(std::span<const Segment> segments, KdTreeConfig config,
                     std::span<const KdSplit> planned) {
    for (;;) {
        config.planned = planned;
        ch04::Story story = ch04::watched_build(segments, config);
        std::size_t taken = 0;
        const auto parts_nothing = [&](const ch04::Turn& turn) {
            if (!turn.split || taken == planned.size()) return false;
            const auto& [axis, position, below] = *turn.split;
            const bool parts = turn.cell.min[axis] < position && position < turn.cell.max[axis];
            taken += parts;
            return !parts;
        };
        if (!std::ranges::any_of(story.turns, parts_nothing)) return story;
        planned = planned.first(taken);
    }
}

std::vector<Segment> moved_segments(PlaneHandles& handles) {
    std::vector<Segment> segments = heinonen_segments();
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const char letter = static_cast<char>('A' + i);
        const auto end = [&](const char* which, char number, Point2& point) {
            point = handles.at(ch04::build_view(), Double2(heinonen_size),
                               fmt::format("{}{}", letter, number),
                               fmt::format("{} end of segment {}", which, letter), point);
        };
        end("first", '1', segments[i].a);
        end("second", '2', segments[i].b);
    }
    return segments;
}

}  // namespace

Answer kd_build(const State& state) {
    PlaneHandles handles(state);
    const std::vector<Segment> segments = moved_segments(handles);
    const std::size_t rule = state.choice("rule", 0, rules),
                      first = state.choice("first", 0, first_planes),
                      part = state.choice("straddlers", 0, straddlers_named);
    constexpr std::array of_rule{Rule::middle, Rule::middle, Rule::median, Rule::sah};
    const std::size_t depth = state.whole("depth", 4, 1, 6);
    const KdTreeConfig config{.rule = of_rule[rule],
                              .straddlers = part == 0 ? Straddlers::clip : Straddlers::duplicate,
                              .max_leaf_size = 1,
                              .max_depth = depth};
    std::vector<KdSplit> planned;
    if (rule == 0) planned.assign(ch04::heinonen_planes().begin(), ch04::heinonen_planes().end());
    if (first > 0) {
        const int axis = static_cast<int>(first) - 1;
        const Point2 on = handles.at(ch04::build_view(), Double2(heinonen_size), "plane",
                                     "a point on the first plane", {8.0f, 8.0f});
        if (planned.empty()) planned.resize(1);
        planned.front() = {axis, on[axis]};
    }
    ch04::Story story = story_of(segments, config, planned);
    const auto planes = std::ranges::count_if(
        story.turns, [](const ch04::Turn& turn) { return turn.split.has_value(); });
    if (rule == 0 && planes == 6) story.plane_names = "quvrts";
    std::string tells = ch04::told_size(story);
    if (const double cost = ch04::expected_cost(story); std::isfinite(cost))
        tells += fmt::format(" A ray costs {:.1f} by the surface area heuristic.", cost);
    return {.drawing = ch04::drawn_build(story),
            .summary = std::move(tells),
            .handles = std::move(handles.handles),
            .choices = {{"rule", "Cells are cut", rules, rule},
                        {"first", "The first plane", first_planes, first},
                        {"straddlers", "Straddlers are named", straddlers_named, part}},
            .sliders = {{"depth", "Depth at most", double(depth), 1.0, 6.0, 1.0}}};
}

}  // namespace space::live
