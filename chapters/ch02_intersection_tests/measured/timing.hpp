/// @file
/// What each test of this chapter costs: nanoseconds per test, medians of interleaved runs on one
/// thread. To be read as ratios.
#pragma once

#include "chapters/ch02_intersection_tests/measured/data.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"

#include <span>
#include <string>
#include <vector>

namespace space::ch02 {

// --- triangles ---

/// Leaves of a tree, and rays that reach them: what a triangle test meets in all later chapters.
struct Leaves {
    std::string scene;
    std::size_t leaf_size = 0;  ///< triangles in each leaf
    std::size_t rays_per_leaf = 0;
    std::vector<Triangle> triangles;  ///< leaf after leaf
    std::vector<Ray> rays;            ///< those of the first leaf, of the second ...

    std::size_t count() const { return triangles.size() / leaf_size; }
    std::size_t tests() const { return rays.size() * leaf_size; }
};
/// `leaves` of eight triangles each with neighbouring middles, and 64 rays for each leaf from
/// random directions, aimed at random points of its box.
Leaves make_leaves(const std::string& scene, std::span<const Triangle> triangles,
                   std::size_t leaves, std::uint64_t seed);

/// Eight large triangles in each leaf, anywhere in the cube [-1, 1]^3, and rays from anywhere
/// around it.
Leaves random_leaves(std::size_t leaves, std::uint64_t seed);

/// Every test of triangle_tests, in its order. What a test prepares is prepared once per ray and
/// leaf (Watertight), or once per triangle outside the measurement (UnitTriangle).
std::vector<Timed> time_triangle_tests(const Leaves& leaves, int rounds);

/// "filter first": FilteredExact; "expansions only": its third stage, asked at once.
std::vector<Timed> time_stages(const Leaves& leaves, int rounds);

/// Lichter23's two tests and the two between, in a loop over all the triangles of a leaf that keeps
/// the nearest hit's t as tmax, as its naive ray tracer does.
std::vector<Timed> time_lichter_tests(const Leaves& leaves, int rounds);

/// The three orders of branches.hpp.
std::vector<Timed> time_orders(Pattern pattern, int rounds);

// --- square roots ---

/// Every form of root_forms() inlined into a loop, the vector forms four at a time, and the
/// library's as a call.
std::vector<TimedRoot> time_roots(int rounds);

// --- boxes, spheres, planes ---

/// Every test of box_tests, in its order; rays are prepared once for all boxes.
std::vector<Timed> time_box_tests(Pattern pattern, int rounds);

/// Every test of sphere_tests, in its order; about half of the rays hit.
std::vector<Timed> time_sphere_tests(int rounds);

/// "general", "axis-aligned": plane_t for random planes.
std::vector<Timed> time_planes(int rounds);

}  // namespace space::ch02
