/// @file
/// How well the fragments of a tree tile its polygons, in numbers: area lost or gained, cracks
/// along common edges, rays that slip through. All of it is decided exactly, so that a zero means
/// none.
#pragma once

#include "chapters/ch03_bsp_trees/bsp_tree.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace space {

/// The ends of an edge, in one order for all polygons that have it.
using EdgeKey = std::array<float, 6>;
EdgeKey edge_key(const Triangle& polygon, int edge);

/// Areas and cracks of all fragments.
struct Tiling {
    double area_error = 0.0;  ///< the worst polygon's |sum of its fragments' areas - its area| /
                              ///< its area; 0 is exactly 0
    std::uint64_t cuts = 0;   ///< how often a plane cuts an edge of two polygons, from both of them
    std::uint64_t cracks = 0;  ///< those of them that have two different points
};
/// `grade` is the one that the tree was built in: it says what a corner is.
Tiling measure_tiling(const BspTree<3>& tree, Grade grade);

/// Rays through a polygon, and how many of them miss all its fragments.
struct SlippedRays {
    std::uint64_t rays = 0, slipped = 0;
};

/// Rays against fragments, as if those were the scene. A fragment in the exact grade is the polygon
/// that its exact corners make; in the others it is the fan of triangles that its rounded corners
/// make.
class FragmentRays {
  public:
    FragmentRays(const BspTree<3>& tree, Grade grade);

    /// Whether the ray's line meets a fragment, or any fragment of the polygon, borders included.
    bool meets(const Ray& ray, const Fragment<3>& fragment) const;
    bool meets(const Ray& ray, std::uint32_t polygon) const;

    /// Rays from all around at points of edges that two polygons share. Those that hit one of the
    /// two should meet a fragment of one of the two.
    SlippedRays at_old_edges(std::uint64_t count, std::uint64_t seed) const;
    /// Rays from all around at points where a polygon was cut. Those that hit it should meet a
    /// fragment of it.
    SlippedRays at_cuts(std::uint64_t count, std::uint64_t seed) const;

  private:
    /// An edge of two polygons, or a cut through one (both the same).
    struct Target {
        Double3 from, to;
        std::array<std::uint32_t, 2> polygons;
    };
    SlippedRays slipped(const std::vector<Target>& targets, std::uint64_t count,
                        std::uint64_t seed) const;
    /// On which side of the directed edge between two corners the ray passes: the sign of (p - o) x
    /// (q - o) . d.
    int side_of_edge(const Ray& ray, const Fragment<3>& fragment, std::size_t p,
                     std::size_t q) const;

    const BspTree<3>& tree_;
    Grade grade_;
    std::vector<std::vector<std::uint32_t>> fragments_;  ///< of each polygon
};

}  // namespace space
