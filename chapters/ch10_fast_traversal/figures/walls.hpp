/// @file
/// Segments of the plane for drawings: with names, with a binary tree over them, and as walls so
/// tall that rays near the ground see nothing but the plane.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace space::ch10 {

/// Segments A, B, C .. and the binned builder's tree over them, a leaf for each.
template <int D>
struct Walls {
    std::vector<Segment> segments;
    std::vector<NamedSegment> named;
    std::vector<Simplex<D>> polygons;  ///< the segments, or walls that stand on them
    BvhNodes<D> binary;

    /// A leaf's segment, or an inner node's number in depth-first order, from 1 on.
    std::string name(std::uint32_t node) const;
    std::vector<std::uint32_t> numbers = {};  ///< of the inner nodes, by node
};
template <int D>
Walls<D> walls_on(std::span<const Segment> segments);

/// So many short segments in clusters by chance, in the square of Heinonen's.
std::vector<Segment> clustered_segments(std::uint64_t seed, int clusters, int in_each);

/// A box seen from above.
template <int D>
Aabb2 from_above(const BasicAabb<D>& box) {
    return {{box.min.x, box.min.y}, {box.max.x, box.max.y}};
}
/// A box on the paper, made larger by some of the paper's units on each side.
void draw_box_on(Svg& svg, const PlaneView& view, const Aabb2& box, double larger,
                 const Style& style);
/// Its corners in order, and its sides: two ends of each.
ConvexCell box_corners(const Aabb2& box);
std::vector<Double2> box_sides(const Aabb2& box);

/// The colour of the n-th wide node in a drawing.
Ink wide_ink(std::size_t n);

}  // namespace space::ch10
