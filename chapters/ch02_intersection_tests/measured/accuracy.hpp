/// @file
/// How wrong each test of this chapter is, counted against exact arithmetic on the same inputs.
/// Plain functions that return plain counts, the same for any number of threads.
#pragma once

#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "chapters/ch02_intersection_tests/shape_tests.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch02 {

/// Wrong decisions of one test.
struct Wrong {
    std::string_view test;
    std::uint64_t decisions = 0;
    std::uint64_t hits = 0;    ///< where exact arithmetic says miss
    std::uint64_t misses = 0;  ///< where it says hit

    double per_million() const {
        return 1e6 * static_cast<double>(hits + misses) / static_cast<double>(decisions);
    }
    void add(const Wrong& other) {
        test = other.test;
        decisions += other.decisions;
        hits += other.hits;
        misses += other.misses;
    }
};

/// Error of a value in units in the last place of the exact one, where both have one.
struct UlpError {
    std::uint64_t values = 0;
    double sum = 0.0, worst = 0.0;

    void add(double ulps) {
        ++values;
        sum += ulps;
        worst = std::max(worst, ulps);
    }
    void add(const UlpError& other) {
        values += other.values;
        sum += other.sum;
        worst = std::max(worst, other.worst);
    }
    double mean() const { return values == 0 ? 0.0 : sum / static_cast<double>(values); }
};
/// |value - exact| in units in the last place of the float nearest to `exact`.
double ulps(float value, double exact);

// --- triangles ---

/// How often each stage of FilteredExact decided.
struct StageCounts {
    std::array<std::uint64_t, 3> count{};
    void decided(Stage stage) { ++count[static_cast<std::size_t>(stage)]; }
};

/// What the triangle tests decide wrongly on one class of inputs.
struct TriangleAccuracy {
    std::string input;
    std::uint64_t pairs = 0, exact_hits = 0;
    StageCounts stages;
    std::array<Wrong, triangle_test_count> wrong;  ///< in the order of triangle_tests
    std::array<UlpError, triangle_test_count> t;
};
/// FilteredExact is the truth here; the chapter's tests hold it against CGAL's exact kernel.
TriangleAccuracy triangle_accuracy(const TriangleInput& input, std::uint64_t pairs,
                                   std::uint64_t seed, unsigned threads);

/// Rays from inside a closed mesh that hit none of its triangles.
struct Leaks {
    std::string mesh;
    std::uint64_t rays = 0;  ///< that hit the mesh in exact arithmetic
    std::array<std::uint64_t, triangle_test_count> leaks{};
};
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

/// Errors in units in the last place of the exact root.
struct RootAccuracy {
    std::string name;
    double worst_binades =
        0.0;  ///< over the floats of [1, 4): errors repeat from one pair of binades to the next
    double correctly_rounded = 0;  ///< share of those
    double worst_normal = 0.0;     ///< over a sample of all normal floats
    double worst_denormal = 0.0;   ///< over a sample of all denormal ones
};
/// Looks at every `stride`-th float of [1, 4) (1: at all 2^24), and at `samples` of each binade and
/// of the denormals.
RootAccuracy root_accuracy(const RootForm& form, std::uint32_t stride, std::uint32_t samples);

// --- boxes ---

/// What the box tests decide wrongly on the same pairs.
struct BoxAccuracy {
    std::uint64_t pairs = 0, exact_hits = 0;
    std::array<Wrong, box_test_count> wrong;  ///< in the order of box_tests
};
/// The 7000 rays of lattice_boxes().
BoxAccuracy lattice_box_accuracy();
BoxAccuracy box_accuracy(std::uint64_t pairs, std::uint64_t seed, unsigned threads);

/// Rays from inside a box all hit it. How many does each test reject?
struct RaysFromInside {
    std::uint64_t rays = 0;
    std::array<std::uint64_t, box_test_count> rejected{};
};
RaysFromInside rays_from_inside(std::uint64_t rays, std::uint64_t seed);

/// Turned boxes by the inverse ray.
struct OrientedBoxes {
    std::uint64_t rays = 0, hits = 0;
    std::uint64_t wrong = 0;   ///< where the same box and ray in double say otherwise
    std::uint64_t around = 0;  ///< rays that hit the axis-aligned box around it (SlabConservative)
    std::uint64_t not_around = 0;  ///< that hit the turned box, but not the one around it
};
OrientedBoxes oriented_box_accuracy(std::uint64_t rays, std::uint64_t seed);

// --- spheres ---

/// What the sphere tests decide wrongly at one distance.
struct SphereAccuracy {
    double distance = 0;  ///< of the ray's origin from the centre, in radii
    std::uint64_t pairs = 0, exact_hits = 0;
    std::array<Wrong, sphere_test_count> wrong;  ///< in the order of sphere_tests
    std::array<UlpError, sphere_test_count> t;   ///< empty for SphereAsPrinted, which has no t
};
/// Rays aimed at a sphere of radius 1, two in three of them inside its outline.
SphereAccuracy sphere_accuracy(double distance, std::uint64_t pairs, std::uint64_t seed,
                               unsigned threads);

/// Rays in all directions from three radii away.
struct SpheresBehind {
    std::uint64_t rays = 0;
    std::uint64_t exact_hits = 0;
    std::uint64_t printed_hits = 0;
    std::uint64_t behind = 0;  ///< hits of the test as printed on a sphere behind the origin
};
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

/// A path of rays that bounce in random directions in a closed room with a bumpy ball, of size 1,
/// `place` from the origin.
struct Bounces {
    std::uint64_t bounces = 0;
    std::uint64_t self_hits = 0;  ///< of the triangle that the ray has just left
    std::uint64_t touches =
        0;  ///< of a neighbour at t = 0 from behind: the origin was rounded into its plane
    std::uint64_t leaks = 0;  ///< the ray hits nothing, or the back of a triangle: it is outside
    double offset = 0.0;      ///< mean distance of the origin from the hit point
};
/// Hits are decided by the test of this index in triangle_tests.
Bounces bounces(const OriginWay& way, std::size_t triangle_test, double place, std::uint64_t count,
                std::uint64_t seed, unsigned threads);

}  // namespace space::ch02
