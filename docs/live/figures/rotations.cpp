#include "chapters/ch09_instancing_and_motion/figures/drawn_refits.hpp"
#include "chapters/ch09_instancing_and_motion/figures/drawn_rotations.hpp"
#include "common/scene.hpp"
#include "docs/live/live.hpp"

#include <fmt/format.h>

#include <cmath>

namespace space::live {
namespace {

/// Handles at the middles of segments that go their ways, in a square; at its foot `room` is free.
class Ways {
  public:
    Ways(const State& state, std::span<const Segment> rest, std::span<const Double2> first,
         const PlaneView& view, std::string_view what, double room = 0.0) {
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const Double2 middle = 0.5 * (Double2(rest[i].a) + Double2(rest[i].b));
            const std::string name(1, static_cast<char>('A' + i));
            const Double2 way = state.point(name, first[i], -view.size, view.size);
            const Double2 a(rest[i].a), b(rest[i].b);
            ways.push_back(glm::clamp(way, Double2(0.0, room) - glm::min(a, b),
                                      Double2(view.size) - glm::max(a, b)));
            handles.push_back({name,
                               fmt::format("{} {}", what, name),
                               ways.back(),
                               Double2(view(middle)),
                               {view.scale, -view.scale}});
        }
    }
    std::vector<Double2> ways = {};
    std::vector<Handle> handles = {};
};

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

Answer rotations(const State& state) {
    const std::vector<Segment> rest = heinonen_segments();
    // Boxes that share a side are drawn apart: the root's is the largest.
    Ways ways(state, rest, ch09::first_drift, ch09::rotations_view, "segment", 0.75);
    const std::vector<Segment> moved = ch09::drifted(rest, ways.ways);
    const auto trees = ch09::followed_trees(rest, moved, {});
    return {.drawing = ch09::drawn_rotations(rest, moved),
            .summary = fmt::format("A ray is expected to cost {:.1f} in the refitted tree, {:.1f} "
                                   "after rotations and {:.1f} in a tree that is built anew.",
                                   trees[0].expected, trees[1].expected, trees[2].expected),
            .handles = std::move(ways.handles)};
}

Answer refits(const State& state) {
    const std::vector<Segment> rest = ch09::walkers_at_rest();
    const PlaneView& view = ch09::refits_view;
    Ways ways(state, rest, ch09::walkers_ways, view, "walker");
    const std::vector<Segment> moved = ch09::drifted(rest, ways.ways);
    const auto handle = [&](std::string name, std::string label, const Double2& first) {
        const Double2 value = state.point(name, first, 0.0, view.size);
        ways.handles.push_back({std::move(name),
                                std::move(label),
                                value,
                                Double2(view(Double2(0.0))),
                                {view.scale, -view.scale}});
        return Point2(value);
    };
    const Point2 from = handle("ray", "start of the ray", ch09::refits_from),
                 through = handle("to", "a point on the ray", ch09::refits_through);
    Ray2 ray{.origin = from, .direction = through - from};
    // Of a part whose reciprocal is no normal float the box test can't tell where the square ends.
    for (int axis = 0; axis < 2; ++axis)
        if (!std::isnormal(1.0f / ray.direction[axis])) ray.direction[axis] = 0.0f;
    if (ray.direction == Vector2(0.0f)) ray.direction = {1.0f, 0.0f};
    const auto trees = ch09::followed_trees(rest, moved, ray);
    const auto cost = [&](std::size_t i) {
        return fmt::format("{} and {}", counted(trees[i].visited.size(), "node"),
                           counted(trees[i].tested.size(), "test"));
    };
    return {.drawing = ch09::drawn_refits(rest, moved, ray, trees),
            .summary = fmt::format("This ray comes to {} in the refitted tree, to {} after "
                                   "rotations, to {} in a tree that is built anew.",
                                   cost(0), cost(1), cost(2)),
            .handles = std::move(ways.handles)};
}

}  // namespace space::live
