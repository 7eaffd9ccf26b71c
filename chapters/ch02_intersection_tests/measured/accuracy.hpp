/// @file
/// How wrong each test of this chapter is, counted against exact arithmetic on the same inputs.
/// Plain functions that return plain counts, the same for any number of threads.
#pragma once

#include "chapters/ch02_intersection_tests/measured/data.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "chapters/ch02_intersection_tests/shape_tests.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch02 {

static_assert(triangle_tests_measured == triangle_test_count);
static_assert(box_tests_measured == box_test_count);
static_assert(sphere_tests_measured == sphere_test_count);

/// Of all these errors.
UlpError summary(std::vector<double> ulps);
/// |value - exact| in units in the last place of the float nearest to `exact`.
double ulps(float value, double exact);

// --- triangles ---

/// FilteredExact is the truth here; the chapter's tests hold it against CGAL's exact kernel.
TriangleAccuracy triangle_accuracy(const TriangleInput& input, std::uint64_t pairs,
                                   std::uint64_t seed, unsigned threads);

/// Rays from the middle of a closed mesh, half of them aimed at edges and half at vertices; the
/// mesh moved by 10^shift (1, 1/2, -1/4) unless shift is 0. A leak is a ray that hits none of its
/// triangles.
Leaks closed_mesh_leaks(int levels, int shift, std::uint64_t rays, std::uint64_t seed,
                        unsigned threads);

// --- square roots ---

/// A way to a square root of one float.
struct RootForm {
    std::string name;
    int rounds;  ///< of Newton's method
    float (*root)(float);
};
/// Newton's with 0 to 4 rounds, by division and by the reciprocal root, the processor's estimate,
/// and the library's.
const std::vector<RootForm>& root_forms();

/// Looks at every `stride`-th float of [1, 4) (1: at all 2^24), and at `samples` of each binade and
/// of the denormals.
RootAccuracy root_accuracy(const RootForm& form, std::uint32_t stride, std::uint32_t samples);

// --- boxes ---

/// The 7000 rays of lattice_boxes().
BoxAccuracy lattice_box_accuracy();
BoxAccuracy box_accuracy(std::uint64_t pairs, std::uint64_t seed, unsigned threads);

RaysFromInside rays_from_inside(std::uint64_t rays, std::uint64_t seed);
/// Triangles and origins on a grid, so that each ray passes exactly through its vertex.
RaysInFaces rays_in_faces(std::uint64_t rays, std::uint64_t seed);

OrientedBoxes oriented_box_accuracy(std::uint64_t rays, std::uint64_t seed);

// --- spheres ---

/// Rays aimed at a sphere of radius 1, two in three of them inside its outline.
SphereAccuracy sphere_accuracy(double distance, std::uint64_t pairs, std::uint64_t seed,
                               unsigned threads);

SpheresBehind spheres_behind(std::uint64_t rays, std::uint64_t seed);

// --- origins of secondary rays ---

/// A rule for where a secondary ray starts.
struct OriginWay {
    std::string_view name;
    /// Where the ray in direction `next` starts that leaves the triangle which `ray` has hit; n
    /// points to its side.
    Point3 (*origin)(const Ray& ray, const Hit& hit, const Triangle& triangle, const Double3& n,
                     const Vector3& next);
};
const std::vector<OriginWay>& origin_ways();

/// Hits are decided by the test of this index in triangle_tests.
Bounces bounces(const OriginWay& way, std::size_t triangle_test, double place, std::uint64_t count,
                std::uint64_t seed, unsigned threads);

}  // namespace space::ch02
