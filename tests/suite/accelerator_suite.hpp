/// @file
/// The suite that every structure of the book goes through. It compares a structure, ray by ray and
/// bit for bit, with the naive loop over the same triangle test, in scenes and on rays where
/// structures fail. What it finds it calls by name.
///
///     TEST_CASE("the suite: k-d tree") { run_suite<KdTree>("k-d tree"); }
///
/// The filtered exact test is the reference: its answers are exact arithmetic's, which
/// naive_test.cpp asks about all of these rays, and a structure must give them all. A test that
/// rounds may hit outside of its triangle, or misplace t, and then a structure may be right where
/// the naive loop is wrong: over such a test another answer is accepted where the exact oracle says
/// just that, and is counted.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch02_intersection_tests/watertight.hpp"
#include "common/accelerator.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/compare.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space {

/// The names of what can be wrong.
namespace fault {
inline constexpr std::string_view crashes_on_empty = "crashes on an empty scene";
inline constexpr std::string_view crashes = "crashes";
inline constexpr std::string_view hangs = "hangs";
inline constexpr std::string_view throws = "throws";
inline constexpr std::string_view drops_a_triangle = "drops a triangle";  // no ray ever finds it
inline constexpr std::string_view prunes_too_early =
    "prunes too early";  // found alone, lost beside others
inline constexpr std::string_view misses_a_hit =
    "misses a hit";  // lost on some rays, found on others
inline constexpr std::string_view invents_a_hit = "reports a hit that is none";
inline constexpr std::string_view ignores_tmin = "ignores tmin";
inline constexpr std::string_view ignores_tmax = "ignores tmax";
inline constexpr std::string_view open_interval = "treats the interval as open";
inline constexpr std::string_view forgets_ties = "forgets the tie rule";
inline constexpr std::string_view stale_uv = "returns stale u, v";
inline constexpr std::string_view answers_invalid_ray = "answers an invalid ray";
inline constexpr std::string_view any_ignores_tmin = "any_hit ignores tmin";
inline constexpr std::string_view any_ignores_tmax = "any_hit ignores tmax";
inline constexpr std::string_view any_ignores_interval = "any_hit ignores tmin or tmax";
inline constexpr std::string_view any_invents_a_hit = "any_hit reports a hit that is none";
inline constexpr std::string_view any_misses_a_hit = "any_hit misses a hit";
inline constexpr std::string_view counting_matters = "counting changes the answer";
inline constexpr std::string_view counts_nothing = "does not count";
inline constexpr std::string_view wrong_shape = "shape is inconsistent";
inline constexpr std::string_view builds_differ = "the same build gives another tree";
inline constexpr std::string_view threads_matter =
    "answers depend on other threads or earlier rays";
inline constexpr std::string_view naive_not_exact = "naive tracing differs from exact arithmetic";
}  // namespace fault

struct Failure {
    std::string_view fault;
    std::string scene;
    std::string diagnosis;  ///< of the first: ray, expected, got
    std::size_t times = 1;  ///< in this scene

    std::string text() const {
        return fmt::format("{} [scene \"{}\", {} {}]: {}", fault, scene, times,
                           times == 1 ? "time" : "times", diagnosis);
    }
};

struct SuiteReport {
    std::vector<Failure> failures;
    std::size_t scenes = 0, rays = 0;
    /// Answers that differ from the naive ones where exact arithmetic does, too.
    std::size_t naive_wrong = 0;
    Tally exact;  ///< the naive answers to those rays that the exact oracle was asked about

    bool names(std::string_view fault) const {
        return std::any_of(failures.begin(), failures.end(),
                           [&](const Failure& failure) { return failure.fault == fault; });
    }
    std::string text() const;
};

/// At edges and vertices, per scene; by hand more, as in   SUITE_RAYS=10000 build/release/tests/...
inline int aimed_rays_of_a_scene() {
    const char* asked = std::getenv("SUITE_RAYS");
    return asked ? std::atoi(asked) : sized(2'500, 120);
}

struct SuiteOptions {
    int aimed_rays = aimed_rays_of_a_scene();
    int other_rays = sized(400, 12);  ///< of each other kind, per scene
    /// About so many per scene whose naive answers the exact oracle sees.
    int exact_rays = sized(100, 8);
    unsigned patience =
        60;  ///< seconds that a scene may take in the child before it counts as hanging
    /// Tries each scene in a child process first, so that a crash or a hang becomes a failure with
    /// a name. Not for structures whose builders keep threads of a library alive: a child has none
    /// of them. A sanitizer names the place of a crash itself.
    bool in_child = sized(true, false);
    std::vector<TestScene> scenes = adversarial_scenes();

    /// A quarter of the rays, and no child process. Sanitized: of every third scene.
    SuiteOptions fewer() const {
        SuiteOptions some = *this;
        some.aimed_rays /= 4;
        some.other_rays /= 4;
        some.in_child = false;
        some.scenes = some_of(scenes);
        return some;
    }
};

/// The triangle tests that structures are examined over. The naive loop over each is compiled once,
/// and asked once about a scene's rays.
enum class Over { filtered_exact, moller_trumbore, moller_trumbore_float, watertight };
template <TriangleTest Test>
inline constexpr Over over = [] {
    if constexpr (std::same_as<Test, FilteredExact>) return Over::filtered_exact;
    if constexpr (std::same_as<Test, MollerTrumbore>) return Over::moller_trumbore;
    if constexpr (std::same_as<Test, MollerTrumboreFloat>) return Over::moller_trumbore_float;
    if constexpr (std::same_as<Test, Watertight>) return Over::watertight;
}();

/// A structure that stands, whatever its type.
struct AnyAccelerator {
    std::function<std::optional<Hit>(const Ray&)> closest_hit;
    std::function<std::optional<Hit>(const Ray&, TraversalCounts&)> counted_closest_hit;
    std::function<bool(const Ray&)> any_hit;
    std::function<bool(const Ray&, TraversalCounts&)> counted_any_hit;
    std::function<TreeShape()> shape;
};
using Builder = std::function<AnyAccelerator(std::span<const Triangle>)>;

template <Accelerator A>
AnyAccelerator any_accelerator(A accelerator) {
    const auto a = std::make_shared<const A>(std::move(accelerator));
    return {
        .closest_hit = [a](const Ray& ray) { return closest_hit(*a, ray); },
        .counted_closest_hit = [a](const Ray& ray,
                                   TraversalCounts& counts) { return a->closest_hit(ray, counts); },
        .any_hit = [a](const Ray& ray) { return any_hit(*a, ray); },
        .counted_any_hit = [a](const Ray& ray,
                               TraversalCounts& counts) { return a->any_hit(ray, counts); },
        .shape = [a] { return a->shape(); }};
}

/// What the suite finds, without failing a test.
SuiteReport examine_accelerator(const Builder& build, Over test, const SuiteOptions& options);
/// Fails the test for everything that the suite finds, and prints what was compared.
SuiteReport check_accelerator(std::string_view name, const Builder& build, Over test,
                              const SuiteOptions& options);

/// The same of structures by their type: `build` makes an A from a std::span<const Triangle>; Test
/// is the triangle test that the structure uses.
template <Accelerator A, TriangleTest Test = FilteredExact, class Build>
SuiteReport examine_accelerator(const Build& build, const SuiteOptions& options = {}) {
    return examine_accelerator(
        [&](std::span<const Triangle> triangles) { return any_accelerator<A>(build(triangles)); },
        over<Test>, options);
}
template <Accelerator A, TriangleTest Test = FilteredExact, class Build>
SuiteReport check_accelerator(std::string_view name, const Build& build,
                              const SuiteOptions& options = {}) {
    return check_accelerator(
        name,
        [&](std::span<const Triangle> triangles) { return any_accelerator<A>(build(triangles)); },
        over<Test>, options);
}

// [run_suite]
/// The whole suite: a structure over the exact test, and with a part of the rays over the lab's two
/// others. Its Config is the same type for each.
template <template <TriangleTest> class A>
void run_suite(std::string_view name, const typename A<FilteredExact>::Config& config = {},
               const SuiteOptions& options = {}) {
    const auto check = [&]<TriangleTest Test>(std::string_view test, const SuiteOptions& rays) {
        check_accelerator<A<Test>, Test>(
            fmt::format("{}, {}", name, test),
            [&](std::span<const Triangle> triangles) { return A<Test>::build(triangles, config); },
            rays);
    };
    check.template operator()<FilteredExact>("filtered-exact", options);
    const SuiteOptions some = options.fewer();
    check.template operator()<MollerTrumboreFloat>("moller-trumbore-float", some);
    check.template operator()<Watertight>("watertight", some);
}
// [run_suite]

}  // namespace space
