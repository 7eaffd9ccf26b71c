#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures/drawn_walk.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/middle_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "common/program/walk_drawing.hpp"
#include "docs/live/live.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space::live {
namespace {

using namespace std::string_view_literals;

constexpr std::array builders{"surface area, bins"sv, "surface area, all cuts"sv,
                              "halved by count"sv, "cut in the middle"sv};
/// Seven segments, one in each leaf, have no more levels.
constexpr std::array levels{"all levels"sv, "the root"sv, "level 1"sv, "level 2"sv,
                            "level 3"sv,    "level 4"sv,  "level 5"sv, "level 6"sv};
constexpr std::array<std::array<Double2, 2>, 7> first_segments{{
    {{{1.5, 2.5}, {12.0, 9.5}}},
    {{{2.0, 1.0}, {5.0, 2.0}}},
    {{{6.0, 12.0}, {7.5, 6.0}}},
    {{{6.5, 13.5}, {9.0, 14.5}}},
    {{{13.5, 4.0}, {14.5, 10.0}}},
    {{{12.5, 12.0}, {15.0, 13.5}}},
    {{{13.0, 1.5}, {15.0, 2.5}}},
}};

template <class Builder>
ch07::Story story(const std::vector<Segment>& segments) {
    typename Builder::Config config;
    config.max_leaf_size = 1;
    if constexpr (
        !requires { config.max_depth; } || requires { config.bins; })
        config.costs = {1.0, 1.0};
    return ch07::watched_build<Builder>(segments, config);
}

/// The perimeters of the boxes of each level, beside the root's: what a ray that meets the root's
/// box expects to meet there.
std::vector<double> chances(const BvhNodes<2>& tree) {
    std::vector<double> sums;
    const HitChance<2> chance(tree.nodes[0].box);
    tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        if (depth == sums.size()) sums.push_back(0.0);
        sums[depth] += chance(tree.nodes[index].box);
    });
    return sums;
}

}  // namespace

Answer bvh_walk(const State& state) {
    const PlaneView view = walk_view(16.0);
    const Double2 zero = Double2(view(Double2(0.0))), unit(view.scale, -view.scale);
    std::vector<Handle> handles;
    const auto handle = [&](std::string name, std::string label, const Double2& first) {
        const Double2 value = state.point(name, first, 0.0, 16.0);
        handles.push_back({std::move(name), std::move(label), value, zero, unit});
        return value;
    };
    const Double2 from = handle("ray", "start of the ray", {0.5, 7.5});
    const Double2 through = handle("to", "a point on the ray", {4.5, 7.75});
    std::vector<Segment> segments;
    for (const auto& [a, b] : first_segments) {
        const char letter = static_cast<char>('A' + segments.size());
        const Double2 one =
            handle(fmt::format("{}1", letter), fmt::format("first end of segment {}", letter), a);
        const Double2 other =
            handle(fmt::format("{}2", letter), fmt::format("second end of segment {}", letter), b);
        segments.push_back({Point2(one), Point2(other)});
    }
    const std::size_t builder = state.choice("builder", 0, builders);
    const ch07::Story built = builder == 0   ? story<BinnedBuilder>(segments)
                              : builder == 1 ? story<SweepBuilder>(segments)
                              : builder == 2 ? story<MedianBuilder>(segments)
                                             : story<MiddleBuilder>(segments);
    // A step along the axis to which the ray keeps is t = 1.
    const Double2 way = through - from;
    const double step = std::max(std::abs(way.x), std::abs(way.y));
    const Ray2 ray{.origin = Point2(from),
                   .direction = step > 0.0 ? Vector2(way / step) : Vector2(1.0f, 0.0f)};
    const std::vector<double> met = chances(built.tree);
    const auto offered = std::span(levels).first(std::min(levels.size(), met.size() + 1));
    const std::size_t shown = state.choice("boxes", 0, offered);
    Svg drawing = ch07::drawn_walk(
        "A ray's walk through a tree of seven segments, step by step, with what waits", built, ray,
        shown > 0 ? std::optional(static_cast<unsigned>(shown - 1)) : std::nullopt);
    double nearest = infinity;
    for (const Segment& segment : built.segments)
        nearest = std::min(nearest, distance_along(ray, segment));
    std::string summary = nearest < double{infinity}
                              ? fmt::format("The nearest hit is at t = {}.", written_t(nearest))
                              : "The ray meets nothing.";
    if (shown > 1)
        summary += fmt::format(
            " Of the boxes of {} a line that meets the root's box meets {:.2f} in the mean.",
            offered[shown], met[shown - 1]);
    return {.drawing = std::move(drawing),
            .summary = std::move(summary),
            .handles = std::move(handles),
            .choices = {{"builder", "Boxes cut by", builders, builder},
                        {"boxes", "Boxes of", offered, shown}}};
}

}  // namespace space::live
