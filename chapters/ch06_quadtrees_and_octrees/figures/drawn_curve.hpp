/// @file
/// Morton codes: how bits of a place become a code, and the curve of all cells in the order of
/// codes.
#pragma once

#include "common/geometry.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace space::ch06 {

inline constexpr double square_of_curve = 16.0;

/// A curve in the square from 0 to 16, and a point whose cell is asked for its code.
struct CurveScene {
    std::uint32_t depth = 3;  ///< of the curve's cells, 1 to 5
    std::optional<Point2> asked = {};
};

/// The curve and the code.
struct DrawnCurve {
    Svg drawing;
    std::string tells;  ///< in a sentence or two
};
DrawnCurve drawn_curve(const CurveScene& scene);
/// Where the square of the curve stands.
PlaneView curve_view();

}  // namespace space::ch06
