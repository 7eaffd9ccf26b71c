/// @file
/// The suite that every structure of the book goes through. It compares a structure, ray by ray and
/// bit for bit, with the naive loop over the same triangle test, in scenes and on rays where
/// structures fail, and asks the exact oracle about a part of the rays. What it finds it calls by
/// name.
///
///     TEST_CASE("the suite: k-d tree") {
///         check_accelerator<KdTree>("k-d tree", [](std::span<const Triangle> t) { return
///         KdTree::build(t, {}); });
///     }
#pragma once

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/accelerator.hpp"
#include "common/measure.hpp"
#include "common/parallel.hpp"
#include "common/program/report.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/compare.hpp"
#include "tests/suite/adversarial_scenes.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <csignal>
#include <exception>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
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
inline constexpr std::string_view beyond_exact = "errs beyond the bound of its triangle test";
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
    Tally exact;  ///< of the rays that the exact oracle was asked about

    bool names(std::string_view fault) const {
        return std::any_of(failures.begin(), failures.end(),
                           [&](const Failure& failure) { return failure.fault == fault; });
    }
    std::string text() const {
        std::string text = fmt::format("{} scenes, {} rays; exact oracle: {}\n", scenes,
                                       with_commas(rays), exact.text());
        for (const Failure& failure : failures) text += "  " + failure.text() + "\n";
        return text;
    }
};

struct SuiteOptions {
#ifdef BOOK_SANITIZED
    int aimed_rays = 1'000;
    int other_rays = 60;
#else
    int aimed_rays = 10'000;  ///< at edges and vertices, per scene
    int other_rays = 400;     ///< of each other kind, per scene
#endif
    int exact_rays = 100;  ///< about so many per scene for the exact oracle
    unsigned patience =
        60;  ///< seconds that a scene may take in the child before it counts as hanging
    /// Tries each scene in a child process first, so that a crash or a hang becomes a failure with
    /// a name. Not for structures whose builders keep threads of a library alive: a child has none
    /// of them.
    bool in_child = true;
    std::vector<TestScene> scenes = adversarial_scenes();
};

namespace detail {

inline bool same_bits(const std::optional<Hit>& x, const std::optional<Hit>& y) {
    const auto bits = [](const Hit& hit) {
        return std::bit_cast<std::array<std::uint32_t, 4>>(hit);
    };
    return x.has_value() == y.has_value() && (!x || bits(*x) == bits(*y));
}

inline std::string words(const Ray& ray) {
    return fmt::format(
        "origin ({:.9g}, {:.9g}, {:.9g}) direction ({:.9g}, {:.9g}, {:.9g}) [{:.9g}, {:.9g}]",
        ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z,
        ray.tmin, ray.tmax);
}
inline std::string words(const std::optional<Hit>& hit) {
    return hit ? fmt::format("triangle {} at t = {:.9g}, u = {:.9g}, v = {:.9g}", hit->triangle,
                             hit->t, hit->u, hit->v)
               : "none";
}

enum class Fate { survived, crashed, hung, threw };

/// Runs the body in a child process.
template <class Body>
Fate fate_in_child(const Body& body, unsigned patience) {
    constexpr int threw = 99;
    const pid_t child = ::fork();
    if (child == 0) {
        for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGBUS, SIGTERM})
            std::signal(signal, SIG_DFL);
        ::alarm(patience);
        try {
            body();
        } catch (...) {
            ::_exit(threw);
        }
        ::_exit(0);
    }
    int status = 0;
    if (child < 0 || ::waitpid(child, &status, 0) != child)
        return Fate::survived;  // no child to be had: in this process, then
    if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGALRM ? Fate::hung : Fate::crashed;
    return WEXITSTATUS(status) == 0       ? Fate::survived
           : WEXITSTATUS(status) == threw ? Fate::threw
                                          : Fate::crashed;
}

template <Accelerator A, TriangleTest Test, class Build>
class Examination {
  public:
    Examination(const Build& build, const SuiteOptions& options)
        : build_(build), options_(options) {}

    SuiteReport run() {
        for (const TestScene& scene : options_.scenes) {
            scene_ = &scene;
            ++report_.scenes;
            try {
                examine();
            } catch (const std::exception& error) {
                fail(fault::throws, error.what());
            }
        }
        return std::move(report_);
    }

  private:
    using Reference = Naive<Test>;
    using Answer = std::optional<Hit>;

    void fail(std::string_view fault, std::string diagnosis) {
        for (Failure& failure : report_.failures)
            if (failure.fault == fault && failure.scene == scene_->name) {
                ++failure.times;
                return;
            }
        report_.failures.push_back({fault, scene_->name, std::move(diagnosis)});
    }

    void examine() {
        const std::span<const Triangle> triangles = scene_->triangles;
        const Reference reference = Reference::build(triangles);
        const std::vector<TestRay> rays = make_rays(reference);
        report_.rays += rays.size();
        if (options_.in_child && !survives(rays)) return;

        const A accelerator = build_(triangles);
        check_shape(accelerator.shape());
        const std::vector<Answer> answers = check_answers(accelerator, reference, rays);
        check_second_build(accelerator, answers, rays);
        check_exactly(answers, rays);
    }

    std::vector<TestRay> make_rays(const Reference& reference) {
        const std::span<const Triangle> triangles = scene_->triangles;
        RayMaker maker(triangles, 2024);
        std::vector<TestRay> rays;
        const auto add_cut = [&](const Ray& ray) {
            if (const Answer hit = closest_hit(reference, ray))
                for (const TestRay& cut : RayMaker::cut_at(ray, hit->t)) rays.push_back(cut);
        };
        for (int i = 0; i < options_.other_rays; ++i) {
            for (const TestRay& ray : {maker.random(), maker.axis_parallel(), maker.within_a_slab(),
                                       maker.from_vertex(), maker.from_face()}) {
                rays.push_back(ray);
                if (i % 8 == 0) add_cut(ray.ray);
            }
            rays.push_back(maker.scaled(maker.random().ray));
        }
        for (int i = 0; i < options_.aimed_rays / 2; ++i) {
            rays.push_back(maker.at_vertex());
            rays.push_back(maker.at_edge());
            if (i % 64 == 0) add_cut(rays.back().ray);
        }
        for (const TestRay& ray : maker.invalid()) rays.push_back(ray);
        // Each triangle alone: the interval is its t and nothing else.
        for (const Triangle& triangle : triangles) {
            Ray probe = maker.probe(triangle);
            const Answer hit = is_valid(probe) ? Test::intersect(probe, triangle) : std::nullopt;
            if (hit) probe.tmin = probe.tmax = hit->t;
            rays.push_back({"probe", probe});
        }
        return rays;
    }

    bool survives(const std::vector<TestRay>& rays) {
        const Fate fate = fate_in_child(
            [&] {
                const A accelerator = build_(scene_->triangles);
                do_not_optimize(accelerator.shape().references);
                for (std::size_t i = 0; i < rays.size(); i += 1 + rays.size() / 500) {
                    do_not_optimize(closest_hit(accelerator, rays[i].ray).has_value());
                    do_not_optimize(any_hit(accelerator, rays[i].ray));
                }
            },
            options_.patience);
        const std::string where = fmt::format(
            "building it from {} triangles and asking it a few rays", scene_->triangles.size());
        if (fate == Fate::crashed)
            fail(scene_->triangles.empty() ? fault::crashes_on_empty : fault::crashes, where);
        if (fate == Fate::hung) fail(fault::hangs, where);
        if (fate == Fate::threw) fail(fault::throws, where);
        return fate == Fate::survived;
    }

    void check_shape(const TreeShape& shape) {
        const auto require = [&](bool holds, std::string_view rule) {
            if (!holds)
                fail(fault::wrong_shape,
                     fmt::format("{}: nodes {}, leaves {}, depth {}, references {}, bytes {}", rule,
                                 shape.nodes.value_or(0), shape.leaves.value_or(0),
                                 shape.depth.value_or(0), shape.references, shape.bytes));
        };
        if (shape.nodes && shape.leaves) {
            require(*shape.leaves <= *shape.nodes, "no more leaves than nodes");
            require(*shape.nodes == 0 || *shape.leaves > 0, "a tree has a leaf");
        }
        if (shape.nodes && shape.depth)
            require(*shape.depth <= (*shape.nodes ? *shape.nodes - 1 : 0),
                    "a path has no more edges than nodes");
        if (shape.sah_cost)
            require(std::isfinite(*shape.sah_cost) && *shape.sah_cost >= 0.0,
                    "the cost is a number, and not negative");
        require(shape.bytes > 0, "it takes memory");
        const auto with_area = static_cast<std::size_t>(
            std::count_if(scene_->triangles.begin(), scene_->triangles.end(),
                          [](const Triangle& t) { return normal(t) != Double3(0.0); }));
        require(shape.references >= with_area, "each triangle with an area is in a leaf");
    }

    struct Mismatch {
        const TestRay* ray;
        Answer expected, got;
    };

    std::vector<Answer> check_answers(const A& accelerator, const Reference& reference,
                                      const std::vector<TestRay>& rays) {
        // Which triangles are the nearest for some ray, and which of those are found.
        std::vector<bool> expected_once(scene_->triangles.size()),
            found_once(scene_->triangles.size());
        std::vector<Mismatch> mismatches;
        std::vector<Answer> answers;
        for (const TestRay& test : rays) {
            const Ray& ray = test.ray;
            const Answer expected = closest_hit(reference, ray),
                         got = closest_hit(accelerator, ray);
            answers.push_back(got);
            if (expected) expected_once[expected->triangle] = true;
            if (got && got->triangle < found_once.size()) found_once[got->triangle] = true;
            if (!same_bits(expected, got)) mismatches.push_back({&test, expected, got});

            TraversalCounts counts, any_counts;
            if (const Answer counted = accelerator.closest_hit(ray, counts);
                !same_bits(counted, got))
                fail(fault::counting_matters, described({&test, got, counted}));
            if (got && counts.triangles_tested == 0)
                fail(fault::counts_nothing, described({&test, expected, got}));
            const bool any = any_hit(accelerator, ray);
            if (any != accelerator.any_hit(ray, any_counts))
                fail(fault::counting_matters,
                     fmt::format("any_hit of the {} ray {}", test.kind, words(ray)));
            if (any != expected.has_value())
                fail(any_fault(reference, ray, any), described_any(test, any));
        }
        for (const Mismatch& mismatch : mismatches) {
            const bool dropped = mismatch.expected && expected_once[mismatch.expected->triangle] &&
                                 !found_once[mismatch.expected->triangle];
            fail(closest_fault(accelerator, mismatch, dropped), described(mismatch));
        }
        return answers;
    }

    std::string_view closest_fault(const A& accelerator, const Mismatch& mismatch,
                                   bool dropped) const {
        const auto& [test, expected, got] = mismatch;
        const Ray& ray = test->ray;
        if (got && !is_valid(ray)) return fault::answers_invalid_ray;
        if (got && got->t < ray.tmin) return fault::ignores_tmin;
        if (got && got->t > ray.tmax) return fault::ignores_tmax;
        if (!expected || (got && nearer(*got, *expected))) return fault::invents_a_hit;
        if (got && got->t == expected->t && got->triangle == expected->triangle)
            return fault::stale_uv;
        // Lost: ask for it alone, and with the interval a little wider where it lies at an end of
        // it.
        const auto finds = [&](float tmin, float tmax) {
            const Answer hit = closest_hit(accelerator, Ray{ray.origin, ray.direction, tmin, tmax});
            return hit && hit->t == expected->t;
        };
        const float t = expected->t, before = std::nextafter(t, -infinity),
                    after = std::nextafter(t, infinity);
        const bool closed = finds(t, t);
        if (!closed && finds(before, after)) return fault::open_interval;
        if (got && got->t == expected->t) return fault::forgets_ties;
        if (dropped) return fault::drops_a_triangle;
        return closed && got ? fault::prunes_too_early : fault::misses_a_hit;
    }

    std::string_view any_fault(const Reference& reference, Ray ray, bool any) const {
        if (!any) return fault::any_misses_a_hit;
        if (!is_valid(ray)) return fault::answers_invalid_ray;
        const bool below = any_hit(reference, {ray.origin, ray.direction, -infinity, ray.tmax});
        const bool above = any_hit(reference, {ray.origin, ray.direction, ray.tmin, infinity});
        if (below && above) return fault::any_ignores_interval;
        return below   ? fault::any_ignores_tmin
               : above ? fault::any_ignores_tmax
                       : fault::any_invents_a_hit;
    }

    std::string described(const Mismatch& m) const {
        return fmt::format("{} ray {}: expected {}, got {}", m.ray->kind, words(m.ray->ray),
                           words(m.expected), words(m.got));
    }
    std::string described_any(const TestRay& test, bool any) const {
        return fmt::format("{} ray {}: any_hit is {}", test.kind, words(test.ray), any);
    }

    /// Built again and asked from several threads at once, it has the same shape and gives the same
    /// answers.
    void check_second_build(const A& accelerator, const std::vector<Answer>& answers,
                            const std::vector<TestRay>& rays) {
        const A second = build_(scene_->triangles);
        std::vector<Answer> again(rays.size());
        parallel_for(rays.size(), 4, 64,
                     [&](std::size_t i) { again[i] = closest_hit(second, rays[i].ray); });
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (same_bits(answers[i], again[i])) continue;
            const bool alone_too = !same_bits(answers[i], closest_hit(second, rays[i].ray)) &&
                                   same_bits(answers[i], closest_hit(accelerator, rays[i].ray));
            fail(alone_too ? fault::builds_differ : fault::threads_matter,
                 described({&rays[i], answers[i], again[i]}));
        }
        const TreeShape x = accelerator.shape(), y = second.shape();
        if (x.nodes != y.nodes || x.leaves != y.leaves || x.depth != y.depth ||
            x.references != y.references || x.sah_cost != y.sah_cost)
            fail(fault::builds_differ,
                 fmt::format("nodes {} and {}, references {} and {}", x.nodes.value_or(0),
                             y.nodes.value_or(0), x.references, y.references));
    }

    void check_exactly(const std::vector<Answer>& answers, const std::vector<TestRay>& rays) {
        const ExactOracle oracle = ExactOracle::build(scene_->triangles);
        const std::size_t step = 1 + rays.size() / static_cast<std::size_t>(options_.exact_rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (i % step != 0) {
                ++report_.exact.skipped;
                continue;
            }
            const Comparison comparison = compare(oracle, rays[i].ray, answers[i]);
            report_.exact.add(comparison);
            // The bound is that of Möller-Trumbore in double.
            if (std::is_same_v<Test, MollerTrumbore> && comparison.beyond_bound)
                fail(fault::beyond_exact,
                     fmt::format("{}: {} ray {}: got {}", name(comparison.agreement), rays[i].kind,
                                 words(rays[i].ray), words(answers[i])));
        }
    }

    const Build& build_;
    const SuiteOptions& options_;
    const TestScene* scene_ = nullptr;
    SuiteReport report_;
};

}  // namespace detail

/// What the suite finds, without failing a test.
template <Accelerator A, TriangleTest Test = MollerTrumbore, class Build>
SuiteReport examine_accelerator(const Build& build, const SuiteOptions& options = {}) {
    return detail::Examination<A, Test, Build>(build, options).run();
}

/// Fails the test for everything that the suite finds, and prints what was compared. `build` makes
/// an A from a std::span<const Triangle>; Test is the triangle test that the structure uses.
template <Accelerator A, TriangleTest Test = MollerTrumbore, class Build>
SuiteReport check_accelerator(std::string_view name, const Build& build,
                              const SuiteOptions& options = {}) {
    SuiteReport report = examine_accelerator<A, Test>(build, options);
    fmt::print("{}: {}", name, report.text());
    for (const Failure& failure : report.failures)
        FAIL_CHECK(std::string(name) << ": " << failure.text());
    CHECK(report.scenes == options.scenes.size());
    return report;
}

}  // namespace space
