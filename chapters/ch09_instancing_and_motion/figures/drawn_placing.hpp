/// @file
/// A house that is scaled, turned and moved: step by step, and in all orders.
#pragma once

#include "chapters/ch09_instancing_and_motion/figures/placed_house.hpp"
#include "common/program/svg.hpp"

#include <string_view>

namespace space::ch09 {

/// T, R and S in the plane. Neither scale may be 0.
struct PlacedBy {
    Double2 translation;
    double cosine, sine;
    Double2 scale;

    ObjectPlacement placement() const { return placed_in_plane(translation, cosine, sine, scale); }
};

inline constexpr PlacedBy placed_first{{4.25, 2}, 0.8, 0.6, {1.5, 0.75}};
inline constexpr PlacedView placing_view{
    .corner = {8, 8}, .scale = 80, .low = {-1.75, -1.6}, .size = {8, 5.1}};
/// S, R and T, one after another; then R before S, then a mirror.
Svg drawn_placing(const PlacedBy& by);

inline constexpr PlacedBy ordered_first{{2, 1}, 0.8, 0.6, {1.75, 0.75}};
/// Of the product TRS.
inline constexpr PlacedView orders_view{
    .corner = {8, 34}, .scale = 23.5, .low = {-2.4, -2.0}, .size = {8.85, 7.0}};
/// What does not fit into a frame is cut off.
Svg drawn_orders(const PlacedBy& by);

/// Where a product of the letters T, R and S takes a point: as products are written, the last one
/// comes first.
Double2 by_product(const PlacedBy& by, std::string_view product, const Double2& p);

}  // namespace space::ch09
