#include "chapters/ch09_instancing_and_motion/figures/drawn_placing.hpp"
#include "docs/live/live.hpp"

#include <fmt/format.h>

#include <cmath>

namespace space::live {
namespace {

using ch09::PlacedBy;

/// A house in the state's hands, where its drawing has its handles.
struct Placing {
    PlacedBy by;
    std::vector<Handle> handles;
};

/// Too narrow a house is no house.
double wide_enough(double scale) {
    return std::abs(scale) >= 0.1 ? scale : std::copysign(0.1, scale);
}

/// Handles stand about the origin of the placed house: to its right and above, by where the axis is
/// turned to; to its right and below, by the scales.
Placing placed_by_hand(const State& state, const PlacedBy& first, const ch09::PlacedView& view) {
    PlacedBy by = first;
    const Double2 origin(view({0, 0})), unit(view.scale, -view.scale);
    by.translation = state.point("T", first.translation, -6.0, 6.5);
    by.translation = glm::clamp(by.translation, view.low, view.low + view.size);
    const Double2 towards = state.point("R", {first.cosine, first.sine}, -2.0, 2.0);
    const double length = std::sqrt(towards.x * towards.x + towards.y * towards.y);
    by.cosine = length > 0.01 ? towards.x / length : 1.0;
    by.sine = length > 0.01 ? towards.y / length : 0.0;
    by.scale = state.point("S", first.scale, -4.0, 4.0);
    by.scale = {wide_enough(by.scale.x), wide_enough(by.scale.y)};
    const Double2 placed(view(by.translation));
    return {by,
            {{"T", "T: where the house's origin goes", by.translation, origin, unit},
             {"R", "R: where its x axis turns to", towards, placed, 1.5 * unit},
             {"S",
              "S: the scales, of x to the right and of y downwards",
              by.scale,
              placed,
              {unit.x, -unit.y}}}};
}

std::string written(const Double2& p) {
    return fmt::format("({}, {})", svg_number(p.x), svg_number(p.y));
}

}  // namespace

Answer placing(const State& state) {
    auto [by, handles] = placed_by_hand(state, ch09::placed_first, ch09::placing_view);
    const glm::dmat4 m = matrix(by.placement());
    return {.drawing = ch09::drawn_placing(by),
            .summary = fmt::format(
                "The columns of T R S are {} and {}, and {} for the origin. Areas become {} times "
                "as large{}.",
                written(Double2(m[0])), written(Double2(m[1])), written(Double2(m[3])),
                svg_number(std::abs(by.scale.x * by.scale.y)),
                by.placement().is_mirrored() ? ", and it is a mirror" : ""),
            .handles = std::move(handles)};
}

Answer placing_orders(const State& state) {
    Placing placing = placed_by_hand(state, ch09::ordered_first, ch09::orders_view);
    const auto corner = [&](std::string_view product) {
        return written(ch09::by_product(placing.by, product, {1, 1}));
    };
    return {.drawing = ch09::drawn_orders(placing.by),
            .summary = fmt::format(
                "The point (1, 1) goes to {} by T R S, to {} by R T S and to {} by S R T.",
                corner("TRS"), corner("RTS"), corner("SRT")),
            .handles = std::move(placing.handles)};
}

}  // namespace space::live
