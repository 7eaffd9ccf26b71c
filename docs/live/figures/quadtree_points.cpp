#include "chapters/ch06_quadtrees_and_octrees/figures/drawn_points.hpp"
#include "docs/live/live.hpp"

namespace space::live {

Answer quadtree_points(const State& state) {
    ch06::PointScene scene;
    const std::vector<Double2> first(scene.points.begin(), scene.points.end()),
        points = state.points("points", first, 0.0, 16.0, 16);
    scene.points.assign(points.begin(), points.end());
    auto& [leaf_size, max_depth, skips] = scene.config;
    leaf_size = state.whole("leaf", leaf_size, 1, 4);
    max_depth = static_cast<std::uint32_t>(state.whole("depth", max_depth, 1, 6));
    const PlaneView view = ch06::points_view();
    ch06::DrawnPoints drawn = ch06::drawn_points(scene);
    return {.drawing = std::move(drawn.drawing),
            .summary = std::move(drawn.tells),
            .sliders = {{"leaf", "Points that a leaf may hold", double(leaf_size), 1.0, 4.0, 1.0},
                        {"depth", "Depth at most", double(max_depth), 1.0, 6.0, 1.0}},
            .points = Points{.name = "points",
                             .label = "point",
                             .values = points,
                             .zero = Double2(view(Double2(0.0))),
                             .unit = {view.scale, -view.scale},
                             .least = 0.0,
                             .most = 16.0,
                             .limit = 16}};
}

}  // namespace space::live
