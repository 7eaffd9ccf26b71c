/// @file
/// What planes across an axis of a cell cost by the surface area heuristic.
#pragma once

#include "common/geometry.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <array>
#include <optional>
#include <string>

namespace space::ch04 {

/// Seven segments in a cell, three of which reach beyond it, and the axis that planes cut.
struct CostScene {
    Aabb2 cell{{0.0f, 0.0f}, {12.0f, 4.5f}};
    std::array<Segment, 7> segments{{{{-1.0f, -6.0f}, {12.5f, 21.0f}},
                                     {{0.5f, -5.0f}, {14.0f, 19.0f}},
                                     {{-2.0f, 6.0f}, {13.75f, -11.5f}},
                                     {{9.0f, 1.0f}, {10.5f, 2.2f}},
                                     {{10.0f, 3.3f}, {11.5f, 4.1f}},
                                     {{9.25f, 2.9f}, {9.75f, 4.0f}},
                                     {{11.25f, 0.75f}, {11.5f, 2.75f}}}};
    int axis = 0;
    std::optional<float> plane = {};  ///< one that is asked for, in the cell
};

/// The cell and its costs.
struct DrawnCosts {
    Svg drawing;
    std::string tells;  ///< in a sentence or two
};
DrawnCosts drawn_costs(const CostScene& scene);
/// Where the cell stands.
PlaneView costs_view();

}  // namespace space::ch04
