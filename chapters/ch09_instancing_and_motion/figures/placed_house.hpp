/// @file
/// A house in the plane, placed: what this chapter's drawings show. Its walls' fronts are outside.
#pragma once

#include "chapters/ch09_instancing_and_motion/placement.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <vector>

namespace space::ch09 {

/// A part of the plane on the paper: from `low` on, `size` across.
struct PlacedView {
    Double2 corner;  ///< of the paper, top left
    double scale;    ///< paper units for one of the plane
    Double2 low, size;

    Point2 operator()(const Double2& p) const { return plane()(p - low); }
    PlaneView plane() const { return {.corner = corner, .scale = scale, .size = size.y}; }
    /// The frame, and the axes of the space whose origin and unit vectors these are.
    void draw_frame(Svg& svg) const;
};

/// In the plane z = 0, a placement turns about z by an angle with this cosine and sine.
ObjectPlacement placed_in_plane(const Double2& translation, double cosine, double sine,
                                const Double2& scale);
Double2 to_world(const ObjectPlacement& placement, const Double2& p);

/// In local space; clockwise, so that fronts are outside. It reaches from -1 to 1 and is not
/// symmetric: it has a chimney.
std::vector<Double2> house();
Aabb house_box();
std::vector<Double2> placed(const ObjectPlacement& placement, const std::vector<Double2>& points);

/// A wall with a tick on its front side.
void draw_wall(Svg& svg, const PlacedView& view, const Double2& from, const Double2& to, Ink ink,
               Ink tick);
/// All walls of a house, as their winding has them.
void draw_walls(Svg& svg, const PlacedView& view, const std::vector<Double2>& corners, Ink ink,
                Ink ticks);
/// Filled softly.
void draw_area(Svg& svg, const PlacedView& view, const std::vector<Double2>& corners, Ink ink,
               bool dashed = false);
/// Arrows from the placed origin along the placed axes, with their letters.
void draw_axes(Svg& svg, const PlacedView& view, const ObjectPlacement& placement, Ink ink,
               const char* x = "*x*", const char* y = "*y*");
std::vector<Double2> corners_of(const Aabb& box);

}  // namespace space::ch09
