#include "chapters/ch03_bsp_trees/figures/drawn_walk.hpp"
#include "docs/live/bsp_scene.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace space::live {

Answer bsp_walk(const State& state) {
    const PlaneView view = walk_view(heinonen_size);
    PlaneHandles handles(state);
    BspScene scene = bsp_scene(state, view, handles);
    const Double2 zero = Double2(view(Double2(0.0))), unit(view.scale, -view.scale),
                  from = state.point("ray", {1.0, 15.0}, 0.0, view.size),
                  through = state.point("to", {2.0, 14.64}, 0.0, view.size);
    handles.handles.push_back({"ray", "start of the ray", from, zero, unit});
    handles.handles.push_back({"to", "a point on the ray, at t = 1", through, zero, unit});
    BasicRay<2> ray{.origin = Point2(from), .direction = Vector2(through - from)};
    if (ray.direction == Vector2(0.0f)) ray.direction = {1.0f, 0.0f};
    const std::vector<WalkStep> steps = ch03::told_walk(scene.story, ray);
    const WalkStep& last = steps.back();
    return {.drawing = ch03::drawn_walk(
                "A ray's walk through the tree of the segments A to G, step by step, with what "
                "waits",
                scene.story, ray, steps),
            .summary = last.hit ? fmt::format("The nearest hit is at t = {}. {}",
                                              written_t(*last.hit), last.tells)
                                : "The ray meets nothing. " + last.tells,
            .handles = std::move(handles.handles),
            .choices = std::move(scene.choices),
            .sliders = std::move(scene.sliders)};
}

}  // namespace space::live
