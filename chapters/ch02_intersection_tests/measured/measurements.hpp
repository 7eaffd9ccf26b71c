/// @file
/// Everything that chapter 2 counts and times, in one value; its charts, and the answers to the
/// sources' claims.
#pragma once

#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "chapters/ch02_intersection_tests/measured/timing.hpp"
#include "common/program/chart.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <initializer_list>
#include <vector>

namespace space::ch02 {

/// How many inputs are counted, and how many rounds are timed.
struct Sizes {
    std::uint64_t pairs;      ///< rays with a triangle each, per input class
    std::uint64_t leak_rays;  ///< per closed mesh
    std::uint32_t root_stride, root_samples;
    std::uint64_t boxes, spheres;  ///< rays with a box or a sphere each, spheres per distance
    std::uint64_t bounces;         ///< per way and place
    int rounds;
};
Sizes sizes(Amount amount);

/// The triangle tests on one scene.
struct SceneTimes {
    std::string scene;
    std::vector<Timed> tests;    ///< in the order of triangle_tests
    std::vector<Timed> lichter;  ///< "first", "fewer roots", "early exit", "improved"
};

/// The box tests, and the orders of one of them, on inputs of one predictability.
struct PatternTimes {
    Pattern pattern;
    std::vector<Timed> boxes;   ///< in the order of box_tests
    std::vector<Timed> orders;  ///< "cheap first", "expensive first", "decide last"
};

/// What one rule for origins gives at one distance from the world's origin.
struct PlacedBounces {
    std::string_view way;
    double place;
    Bounces bounces;
};

/// All that a run counts and times.
struct Measurements {
    std::vector<TriangleAccuracy> triangles;  ///< in the order of triangle_inputs()
    std::vector<Leaks> leaks;
    std::vector<RootAccuracy> roots;  ///< in the order of root_forms()
    BoxAccuracy lattice, boxes;
    RaysFromInside from_inside;
    OrientedBoxes oriented;
    std::vector<SphereAccuracy> spheres;
    SpheresBehind behind;
    std::vector<PlacedBounces> bounces;

    std::vector<SceneTimes> triangle_times;  ///< of random triangles and five scenes
    std::vector<TimedRoot> root_times;
    std::vector<PatternTimes> pattern_times;
    std::vector<Timed> sphere_times, plane_times;
};

/// A part fills in its own members. Counts do not depend on the number of threads; times are taken
/// on one.
using Part = void (*)(const Options& options, Measurements& measured);
void count_triangles(const Options& options, Measurements& measured);
void count_leaks(const Options& options, Measurements& measured);
void count_roots(const Options& options, Measurements& measured);
void count_boxes(const Options& options, Measurements& measured);
void count_spheres(const Options& options, Measurements& measured);
void count_bounces(const Options& options, Measurements& measured);
void time_triangles(const Options& options, Measurements& measured);
void time_patterns(const Options& options,
                   Measurements& measured);  ///< boxes, and orders of a triangle test
void time_others(const Options& options, Measurements& measured);  ///< roots, spheres, planes

/// What these parts count and time, each once in a program's run: tables, claims and charts show
/// the same.
const Measurements& measure(const Options& options, std::initializer_list<Part> parts);
const Measurements& measure_all(const Options& options);

/// A test's time as a multiple of MollerTrumboreFloat's on the same scene.
double relative_time(const SceneTimes& scene, std::string_view test);

/// Nanoseconds per triangle test against leaks, per root against the worst error, per box test
/// against boxes missed; wrong decisions about spheres against the distance.
Chart triangle_chart(const Measurements& measured);
Chart root_chart(const Measurements& measured);
Chart box_chart(const Measurements& measured);
Chart sphere_chart(const Measurements& measured);

/// What is promised never to happen: hits that the conservative box test misses.
std::uint64_t wrong_answers(const Measurements& measured);

/// The answers to L1 L2 L3 L4 L5 L8 L9 O4 O5 O12 O13 H15.
std::vector<ClaimAnswer> answer_claims(const Measurements& measured);

}  // namespace space::ch02
