#include "chapters/ch04_kd_trees/figures/drawn_costs.hpp"
#include "docs/live/live.hpp"
#include "docs/live/plane_handles.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

namespace space::live {

Answer plane_costs(const State& state) {
    using namespace std::string_view_literals;
    static constexpr std::array axes{"x"sv, "y"sv};
    ch04::CostScene scene;
    const PlaneView view = ch04::costs_view();
    const Double2 most(scene.cell.max);
    PlaneHandles handles(state);
    const std::size_t axis = state.choice("axis", 0, axes);
    scene.axis = static_cast<int>(axis);
    // Until it is moved the plane is not there: the figure is the book's.
    const Point2 plane =
        handles.at(view, most, "plane", "a point on the plane that is asked about", {6.0f, 2.25f});
    if (plane != Point2(6.0f, 2.25f) || axis > 0) scene.plane = plane[scene.axis];
    for (std::size_t i = 3; i < scene.segments.size(); ++i) {
        const auto end = [&](const char* which, int number, Point2& point) {
            point = handles.at(view, most, fmt::format("s{}{}", i - 2, number),
                               fmt::format("{} end of the short segment {}", which, i - 2), point);
        };
        end("first", 1, scene.segments[i].a);
        end("second", 2, scene.segments[i].b);
    }
    ch04::DrawnCosts drawn = ch04::drawn_costs(scene);
    return {.drawing = std::move(drawn.drawing),
            .summary = std::move(drawn.tells),
            .handles = std::move(handles.handles),
            .choices = {{"axis", "Planes across", axes, axis}}};
}

}  // namespace space::live
