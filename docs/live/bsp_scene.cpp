#include "docs/live/bsp_scene.hpp"

#include "common/scene.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace space::live {
namespace {

using namespace std::string_view_literals;

constexpr std::array splitters{"by the rule"sv, "A"sv, "B"sv, "C"sv, "D"sv, "E"sv, "F"sv, "G"sv};
/// The thesis's: G, E, B, A.
constexpr std::array<std::size_t, 4> first_splitters{7, 5, 2, 1};
constexpr std::array ordinals{"First"sv, "Second"sv, "Third"sv, "Fourth"sv};

using Rule = BspConfig::SplitterChoice;
constexpr std::array rules{Rule::first, Rule::random, Rule::balanced, Rule::fewest_splits,
                           Rule::weighted};
constexpr std::array rule_names{"the first of the set"sv, "any of the set"sv, "most even halves"sv,
                                "fewest cuts"sv, "even halves and few cuts"sv};

}  // namespace

BspScene bsp_scene(const State& state, const PlaneView& view, PlaneHandles& handles) {
    BspScene scene;
    std::vector<Segment> segments = heinonen_segments();
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const char letter = static_cast<char>('A' + static_cast<int>(i));
        const auto end = [&](int which, const Point2& first) {
            return handles.at(
                view, Double2(view.size), fmt::format("{}{}", letter, which),
                fmt::format("{} end of segment {}", which == 1 ? "first" : "second", letter),
                first);
        };
        segments[i] = {end(1, segments[i].a), end(2, segments[i].b)};
    }
    std::vector<std::uint32_t> order;
    for (std::size_t i = 0; i < ordinals.size(); ++i) {
        const std::string name = fmt::format("splitter{}", i + 1);
        const std::size_t chosen = state.choice(name, first_splitters[i], splitters);
        if (chosen > 0) order.push_back(static_cast<std::uint32_t>(chosen - 1));
        scene.choices.push_back({name, fmt::format("{} splitter", ordinals[i]), splitters, chosen});
    }
    const std::size_t rule = state.choice("rule", 0, rule_names);
    scene.choices.push_back({"rule", "Else", rule_names, rule});
    const double weight = state.number("weight", 8.0, 0.0, 16.0);
    if (rules[rule] == Rule::weighted)
        scene.sliders.push_back(
            {"weight", "A cut costs as much as an imbalance of", weight, 0.0, 16.0, 0.5});

    const double size = view.size;
    scene.story = ch03::watched_build(
        segments, {.splitter = rules[rule], .split_weight = weight, .order = order},
        {{0.0, 0.0}, {size, 0.0}, {size, size}, {0.0, size}});
    return scene;
}

}  // namespace space::live
