#include "chapters/ch06_quadtrees_and_octrees/figures/drawn_curve.hpp"
#include "docs/live/live.hpp"
#include "docs/live/plane_handles.hpp"

namespace space::live {

Answer morton_curve(const State& state) {
    ch06::CurveScene scene;
    scene.depth = static_cast<std::uint32_t>(state.whole("depth", scene.depth, 1, 5));
    PlaneHandles handles(state);
    // At the square's middle nothing is asked yet: the figure is the book's.
    const Point2 at = handles.at(ch06::curve_view(), Double2(ch06::square_of_curve), "at",
                                 "a point of the cell whose code is asked for", {8.0f, 8.0f});
    if (at != Point2(8.0f)) scene.asked = at;
    ch06::DrawnCurve drawn = ch06::drawn_curve(scene);
    return {.drawing = std::move(drawn.drawing),
            .summary = std::move(drawn.tells),
            .handles = std::move(handles.handles),
            .sliders = {{"depth", "Depth", double(scene.depth), 1.0, 5.0, 1.0}}};
}

}  // namespace space::live
