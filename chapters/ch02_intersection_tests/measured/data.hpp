/// @file
/// Everything that chapter 2 counts and times, as plain values: enough for its tables, charts and
/// verdicts.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch02 {

/// How many tests triangle_tests, box_tests and sphere_tests name.
inline constexpr std::size_t triangle_tests_measured = 8, box_tests_measured = 6,
                             sphere_tests_measured = 4;

// --- counted ---

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

/// Errors of values in units in the last place of the exact ones, where both have one.
struct UlpError {
    std::uint64_t values = 0;
    double median = 0.0, worst = 0.0;  ///< a mean would be ruled by the few worst
};

/// How often each stage of FilteredExact decided.
struct StageCounts {
    std::array<std::uint64_t, 3> count{};
    void decided(auto stage) { ++count[static_cast<std::size_t>(stage)]; }
};

/// What the triangle tests decide wrongly on one class of inputs.
struct TriangleAccuracy {
    std::string input;
    std::uint64_t pairs = 0, exact_hits = 0;
    StageCounts stages;
    std::array<Wrong, triangle_tests_measured> wrong;  ///< in the order of triangle_tests
    std::array<UlpError, triangle_tests_measured> t;
};
/// Rays from inside a closed mesh that hit none of its triangles.
struct Leaks {
    std::string mesh;
    std::uint64_t rays = 0;  ///< that hit the mesh in exact arithmetic
    std::array<std::uint64_t, triangle_tests_measured> leaks{};
};
/// Errors in units in the last place of the exact root.
struct RootAccuracy {
    std::string name;
    double worst_binades =
        0.0;  ///< over the floats of [1, 4): errors repeat from one pair of binades to the next
    double correctly_rounded = 0;  ///< share of those
    double worst_normal = 0.0;     ///< over a sample of all normal floats
    double worst_denormal = 0.0;   ///< over a sample of all denormal ones
};
/// What the box tests decide wrongly on the same pairs.
struct BoxAccuracy {
    std::uint64_t pairs = 0, exact_hits = 0;
    std::array<Wrong, box_tests_measured> wrong;  ///< in the order of box_tests
};
/// Rays from inside a box all hit it. How many does each test reject?
struct RaysFromInside {
    std::uint64_t rays = 0;
    std::array<std::uint64_t, box_tests_measured> rejected{};
};
/// Rays in the plane of a face of a triangle's box that hit the triangle, in a vertex on that face.
struct RaysInFaces {
    std::uint64_t rays = 0;
    std::uint64_t in_closed_box = 0;  ///< those that meet the closed box, in exact arithmetic
    std::array<std::uint64_t, box_tests_measured> rejected{};
};
/// Turned boxes by the inverse ray.
struct OrientedBoxes {
    std::uint64_t rays = 0, hits = 0;
    std::uint64_t wrong = 0;   ///< where the same box and ray in double say otherwise
    std::uint64_t around = 0;  ///< rays that hit the axis-aligned box around it (SlabConservative)
    std::uint64_t not_around = 0;  ///< that hit the turned box, but not the one around it
};
/// What the sphere tests decide wrongly at one distance.
struct SphereAccuracy {
    double distance = 0;  ///< of the ray's origin from the centre, in radii
    std::uint64_t pairs = 0, exact_hits = 0;
    std::array<Wrong, sphere_tests_measured> wrong;  ///< in the order of sphere_tests
    std::array<UlpError, sphere_tests_measured> t;   ///< empty for SphereAsPrinted, which has no t
};
/// Rays in all directions from three radii away.
struct SpheresBehind {
    std::uint64_t rays = 0;
    std::uint64_t exact_hits = 0;
    std::uint64_t printed_hits = 0;
    std::uint64_t behind = 0;  ///< hits of the test as printed on a sphere behind the origin
};
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
/// One volume in three arithmetics, and how far off double may be.
struct Volume {
    double in_float = 0.0, in_double = 0.0, exact = 0.0, bound = 0.0;
};
/// A volume in one arithmetic, and which of the two triangles at its edge a test in that arithmetic
/// hits.
struct SignRow {
    std::string_view arithmetic;
    double volume = 0.0;
    bool first = false, second = false;
};
/// The same ray in three arithmetics.
struct SignExample {
    std::array<SignRow, 3> rows{};
    double bound = 0.0;  ///< of the volume's error in double
};
/// Small volumes of large whole numbers.
struct LostSigns {
    std::uint64_t volumes = 0;
    std::uint64_t in_float = 0, in_double = 0;  ///< whose sign comes out as another
    std::uint64_t certain = 0;                  ///< beyond the bound of double's error
    std::uint64_t certain_wrong = 0;            ///< of these: none, or the bound is wrong
    double worst_error = 0.0;                   ///< of double
};
// --- timed, on one thread ---

/// A median time and what took it.
struct Timed {
    std::string test;
    double ns;  ///< per test
};
/// The time of one of them. @throws std::out_of_range
double ns_of(const std::vector<Timed>& times, std::string_view test);

/// How well a processor can guess what a test's branches do.
enum class Pattern {
    all_hit,       ///< every test takes the same way, to its end
    all_miss,      ///< every test takes the same way, out at the first exit
    unpredictable  ///< about half of the tests hit, and those that miss leave anywhere, in random
                   ///< order
};
inline constexpr Pattern patterns[] = {Pattern::all_hit, Pattern::all_miss, Pattern::unpredictable};
std::string_view name(Pattern pattern);

/// A median time of one form of the root with so many rounds.
struct TimedRoot {
    std::string test;
    int rounds;
    double ns;  ///< per root
};
/// The triangle tests on one scene.
struct SceneTimes {
    std::string scene;
    std::vector<Timed> tests;    ///< in the order of triangle_tests
    std::vector<Timed> lichter;  ///< "first", those of lichter_variants.hpp, "improved"
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
    SignExample sign_example;
    LostSigns signs;
    double worst_known_share = 0.0;   ///< of the filter's bound
    std::vector<RootAccuracy> roots;  ///< in the order of root_forms()
    BoxAccuracy lattice, boxes;
    RaysFromInside from_inside;
    RaysInFaces in_faces;
    OrientedBoxes oriented;
    std::vector<SphereAccuracy> spheres;
    SpheresBehind behind;
    std::vector<PlacedBounces> bounces;

    /// Times; none with --counts.
    std::vector<SceneTimes> triangle_times;  ///< of random triangles and five scenes
    std::vector<TimedRoot> root_times;
    std::vector<PatternTimes> pattern_times;
    std::vector<Timed> sphere_times, plane_times;
    std::vector<Timed> stage_times;  ///< "filter first", "expansions only"
};

/// A test's time as a multiple of MollerTrumboreFloat's on the same scene.
double relative_time(const SceneTimes& scene, std::string_view test);

}  // namespace space::ch02
