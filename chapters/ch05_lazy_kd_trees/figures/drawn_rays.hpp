/// @file
/// A lazy tree over segments, ray by ray: what nodes and walks told their observers becomes the
/// steps of a drawing, through which a page leads its reader.
#pragma once

#include "chapters/ch05_lazy_kd_trees/lazy_kd_nodes.hpp"
#include "common/geometry.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"
#include "common/scene.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace space::ch05 {

/// Who asks, and what the tree is like.
struct LazyRays {
    std::vector<Segment> segments = heinonen_segments();  ///< 1 to 26, in the drawings' square
    std::vector<Ray2> rays{{.origin = {0.5f, 14.125f}, .direction = {1.0f, -0.5f}},
                           {.origin = {0.5f, 13.0f}, .direction = {1.0f, -0.375f}},
                           {.origin = {0.5f, 5.5f}, .direction = {1.0f, -0.125f}}};
    bool fan = false;  ///< the rays are many: none is told of that makes no node
    LazyKdTreeConfig::Rule rule = LazyKdTreeConfig::Rule::median;
    std::size_t max_depth = 3;
};

/// What came of it.
struct DrawnRays {
    Svg drawing;
    std::string tells;  ///< in a sentence or two
};
DrawnRays drawn_rays(const LazyRays& asked);
/// Where the plane stands.
PlaneView rays_view();

}  // namespace space::ch05
