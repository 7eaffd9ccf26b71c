#include "tests/suite/accelerator_suite.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/measure.hpp"
#include "common/parallel.hpp"
#include "common/program/report.hpp"
#include "tests/suite/test_rays.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <csignal>
#include <exception>
#include <map>
#include <tuple>

namespace space {
namespace {

using Answer = std::optional<Hit>;

/// Every ray is asked once for its nearest hit and once for any; every fifth (sanitized: third), so
/// that each kind has its turn, also with counting, and of a second build by several threads.
constexpr std::size_t asked_again = sized(5, 3);

bool same_bits(const std::optional<Hit>& x, const std::optional<Hit>& y) {
    const auto bits = [](const Hit& hit) {
        return std::bit_cast<std::array<std::uint32_t, 4>>(hit);
    };
    return x.has_value() == y.has_value() && (!x || bits(*x) == bits(*y));
}

std::string words(const Ray& ray) {
    return fmt::format(
        "origin ({:.9g}, {:.9g}, {:.9g}) direction ({:.9g}, {:.9g}, {:.9g}) [{:.9g}, {:.9g}]",
        ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z,
        ray.tmin, ray.tmax);
}
std::string words(const std::optional<Hit>& hit) {
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

// -------------------------------------------------------------------------------------------------
// What structures are asked, and what is right

AnyAccelerator naive_over(Over test, std::span<const Triangle> triangles) {
    switch (test) {
        case Over::moller_trumbore:
            return any_accelerator(Naive<MollerTrumbore>::build(triangles));
        case Over::moller_trumbore_float:
            return any_accelerator(Naive<MollerTrumboreFloat>::build(triangles));
        case Over::watertight:
            return any_accelerator(Naive<Watertight>::build(triangles));
        case Over::filtered_exact:
            break;
    }
    return any_accelerator(Naive<FilteredExact>::build(triangles));
}

std::vector<TestRay> make_rays(Over test, std::span<const Triangle> triangles,
                               const SuiteOptions& options) {
    const AnyAccelerator naive = naive_over(test, triangles);
    RayMaker maker(triangles, 2024);
    std::vector<TestRay> rays;
    const auto add_cut = [&](const Ray& ray) {
        if (const Answer hit = naive.closest_hit(ray))
            for (const TestRay& cut : RayMaker::cut_at(ray, hit->t)) rays.push_back(cut);
    };
    for (int i = 0; i < options.other_rays; ++i) {
        for (const TestRay& ray : {maker.random(), maker.axis_parallel(), maker.within_a_slab(),
                                   maker.from_vertex(), maker.from_face()}) {
            rays.push_back(ray);
            if (i % 8 == 0) add_cut(ray.ray);
        }
        rays.push_back(maker.scaled(maker.random().ray));
    }
    for (int i = 0; i < options.aimed_rays / 2; ++i) {
        rays.push_back(maker.at_vertex());
        rays.push_back(maker.at_edge());
        if (i % 64 == 0) add_cut(rays.back().ray);
    }
    for (const TestRay& ray : maker.invalid()) rays.push_back(ray);
    // Each triangle alone (sanitized: every fourth): the interval is its t and nothing else.
    for (std::size_t i = 0; i < triangles.size(); i += sized(1, 4)) {
        const Triangle& triangle = triangles[i];
        Ray probe = maker.probe(triangle);
        if (const Answer hit = naive_over(test, std::array{triangle}).closest_hit(probe))
            probe.tmin = probe.tmax = hit->t;
        rays.push_back({"probe", probe});
    }
    return rays;
}

/// Whether exact arithmetic gives the answer, too: a triangle at the smallest t, or none.
bool is_right(const std::vector<ExactHit>& hits, const Answer& answer) {
    if (hits.empty() || !answer) return hits.empty() && !answer;
    return std::any_of(hits.begin(), hits.end(), [&](const ExactHit& hit) {
        return hit.t == hits.front().t && hit.triangle == answer->triangle;
    });
}
/// The contract to the letter: of the float t that are smallest, the smallest index.
bool is_exact(const std::vector<ExactHit>& hits, const Answer& answer) {
    if (!is_right(hits, answer)) return false;
    if (!answer) return true;
    for (const ExactHit& hit : hits)
        if (hit.t == hits.front().t && hit.triangle < answer->triangle) return false;
    return answer->t == hits.front().t;
}

/// The rays for a scene and the naive answers to them, made once for all structures.
struct Examination {
    std::vector<Triangle> triangles;
    std::vector<TestRay> rays;
    std::vector<Answer> answers;
    Tally exact;
    std::string naive_fault;  ///< the first answer that the triangle test does not excuse

    Examination(const TestScene& scene, Over test, const SuiteOptions& options)
        : triangles(scene.triangles), rays(make_rays(test, triangles, options)) {
        const AnyAccelerator naive = naive_over(test, triangles);
        answers.resize(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = naive.closest_hit(rays[i].ray);
        ask_oracle(test, static_cast<std::size_t>(options.exact_rays));
    }

  private:
    void ask_oracle(Over test, std::size_t about) {
        const ExactOracle oracle = ExactOracle::build(triangles);
        const std::size_t step = std::max<std::size_t>(1, rays.size() / about);
        std::vector<std::pair<Comparison, bool>> asked((rays.size() + step - 1) / step);
        parallel_for(asked.size(), std::max(1u, std::thread::hardware_concurrency()), 16,
                     [&](std::size_t i) {
                         const Ray& ray = rays[i * step].ray;
                         const Answer& answer = answers[i * step];
                         const Comparison comparison = compare(oracle, ray, answer);
                         const bool excused =
                             test == Over::filtered_exact    ? is_exact(oracle.hits(ray), answer)
                             : test == Over::moller_trumbore ? !comparison.beyond_bound
                                                             : true;
                         asked[i] = {comparison, excused};
                     });
        exact.skipped = rays.size() - asked.size();
        for (std::size_t i = 0; i < asked.size(); ++i) {
            const auto& [comparison, excused] = asked[i];
            exact.add(comparison);
            if (!excused && naive_fault.empty())
                naive_fault = fmt::format("{}: {} ray {}: got {}", name(comparison.agreement),
                                          rays[i * step].kind, words(rays[i * step].ray),
                                          words(answers[i * step]));
        }
    }
};

const Examination& examination(const TestScene& scene, Over test, const SuiteOptions& options) {
    static std::map<std::tuple<std::string, Over, int, int, int>, Examination> made;
    const auto key =
        std::tuple(scene.name, test, options.aimed_rays, options.other_rays, options.exact_rays);
    const auto [place, is_new] = made.try_emplace(key, scene, test, options);
    if (!is_new && place->second.triangles != scene.triangles)
        throw std::logic_error("two scenes of one name: " + scene.name);
    return place->second;
}

// -------------------------------------------------------------------------------------------------
// A structure's answers

class Examiner {
  public:
    Examiner(const Builder& build, Over test, const SuiteOptions& options)
        : build_(build), test_(test), options_(options) {}

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
    struct Mismatch {
        const TestRay* ray;
        Answer expected, got;
    };

    void fail(std::string_view fault, std::string diagnosis) {
        for (Failure& failure : report_.failures)
            if (failure.fault == fault && failure.scene == scene_->name) {
                ++failure.times;
                return;
            }
        report_.failures.push_back({fault, scene_->name, std::move(diagnosis)});
    }

    void examine() {
        const Examination& asked = examination(*scene_, test_, options_);
        report_.rays += asked.rays.size();
        report_.exact += asked.exact;
        if (!asked.naive_fault.empty()) fail(fault::naive_not_exact, asked.naive_fault);
        if (options_.in_child && !survives(asked.rays)) return;

        const AnyAccelerator accelerator = build_(scene_->triangles);
        check_shape(accelerator.shape());
        const std::vector<Answer> answers = check_closest(accelerator, asked);
        check_any(accelerator, asked);
        check_second_build(accelerator, answers, asked.rays);
    }

    bool survives(const std::vector<TestRay>& rays) {
        const Fate fate = fate_in_child(
            [&] {
                const AnyAccelerator accelerator = build_(scene_->triangles);
                do_not_optimize(accelerator.shape().references);
                for (std::size_t i = 0; i < rays.size(); i += 1 + rays.size() / 500) {
                    do_not_optimize(accelerator.closest_hit(rays[i].ray).has_value());
                    do_not_optimize(accelerator.any_hit(rays[i].ray));
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

    std::vector<ExactHit> exact_hits(const Ray& ray) const {
        return ExactOracle::build(scene_->triangles).hits(ray);
    }
    /// Whether another answer than the naive one is to be accepted: where the triangle test may
    /// err, and did. It took another triangle for the nearest; or it placed a triangle too near,
    /// and a hit between there and the triangle's true place ended the search in front to back
    /// order.
    bool naive_is_wrong(const Ray& ray, const Answer& naive, const Answer& got) {
        if (test_ == Over::filtered_exact) return false;
        const std::vector<ExactHit> hits = exact_hits(ray);
        const bool misplaced = naive && got && !hits.empty() && naive->t < hits.front().t &&
                               naive->t <= got->t && got->t <= hits.front().t;
        const bool wrong = !is_right(hits, naive) || misplaced;
        report_.naive_wrong += wrong;
        return wrong;
    }
    /// The same of any_hit, which the naive loop may answer rightly for a triangle that is not hit.
    bool any_naive_is_wrong(const Ray& ray, const Answer& naive) {
        if (test_ == Over::filtered_exact) return false;
        const bool wrong = !is_right(exact_hits(ray), naive);
        report_.naive_wrong += wrong;
        return wrong;
    }

    std::vector<Answer> check_closest(const AnyAccelerator& accelerator, const Examination& asked) {
        // Which triangles are the nearest for some ray, and which of those are found.
        std::vector<bool> expected_once(scene_->triangles.size()),
            found_once(scene_->triangles.size());
        std::vector<Mismatch> mismatches;
        std::vector<Answer> answers;
        for (std::size_t i = 0; i < asked.rays.size(); ++i) {
            const TestRay& test = asked.rays[i];
            const Answer &expected = asked.answers[i], got = accelerator.closest_hit(test.ray);
            answers.push_back(got);
            if (expected) expected_once[expected->triangle] = true;
            if (got && got->triangle < found_once.size()) found_once[got->triangle] = true;
            if (!same_bits(expected, got) && !naive_is_wrong(test.ray, expected, got))
                mismatches.push_back({&test, expected, got});

            if (i % asked_again != 0) continue;
            TraversalCounts counts;
            if (const Answer counted = accelerator.counted_closest_hit(test.ray, counts);
                !same_bits(counted, got))
                fail(fault::counting_matters, described({&test, got, counted}));
            if (got && counts.triangles_tested == 0)
                fail(fault::counts_nothing, described({&test, expected, got}));
        }
        for (const Mismatch& mismatch : mismatches) {
            const bool dropped = mismatch.expected && expected_once[mismatch.expected->triangle] &&
                                 !found_once[mismatch.expected->triangle];
            fail(closest_fault(accelerator, mismatch, dropped), described(mismatch));
        }
        return answers;
    }

    void check_any(const AnyAccelerator& accelerator, const Examination& asked) {
        const AnyAccelerator naive = naive_over(test_, scene_->triangles);
        for (std::size_t i = 0; i < asked.rays.size(); ++i) {
            const TestRay& test = asked.rays[i];
            TraversalCounts counts;
            const bool any = accelerator.any_hit(test.ray);
            if (i % asked_again == 0 && any != accelerator.counted_any_hit(test.ray, counts))
                fail(fault::counting_matters,
                     fmt::format("any_hit of the {} ray {}", test.kind, words(test.ray)));
            if (any == asked.answers[i].has_value() ||
                any_naive_is_wrong(test.ray, asked.answers[i]))
                continue;
            fail(any_fault(naive, test.ray, any), described_any(test, any));
        }
    }
    std::string_view closest_fault(const AnyAccelerator& accelerator, const Mismatch& mismatch,
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
            const Answer hit = accelerator.closest_hit(Ray{ray.origin, ray.direction, tmin, tmax});
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

    std::string_view any_fault(const AnyAccelerator& naive, Ray ray, bool any) const {
        if (!any) return fault::any_misses_a_hit;
        if (!is_valid(ray)) return fault::answers_invalid_ray;
        const bool below = naive.any_hit({ray.origin, ray.direction, -infinity, ray.tmax});
        const bool above = naive.any_hit({ray.origin, ray.direction, ray.tmin, infinity});
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
    void check_second_build(const AnyAccelerator& accelerator, const std::vector<Answer>& answers,
                            const std::vector<TestRay>& rays) {
        const AnyAccelerator second = build_(scene_->triangles);
        std::vector<Answer> again((rays.size() + asked_again - 1) / asked_again);
        parallel_for(again.size(), 4, 16, [&](std::size_t k) {
            again[k] = second.closest_hit(rays[k * asked_again].ray);
        });
        for (std::size_t k = 0; k < again.size(); ++k) {
            const std::size_t i = k * asked_again;
            if (same_bits(answers[i], again[k])) continue;
            const bool alone_too = !same_bits(answers[i], second.closest_hit(rays[i].ray)) &&
                                   same_bits(answers[i], accelerator.closest_hit(rays[i].ray));
            fail(alone_too ? fault::builds_differ : fault::threads_matter,
                 described({&rays[i], answers[i], again[k]}));
        }
        const TreeShape x = accelerator.shape(), y = second.shape();
        if (x.nodes != y.nodes || x.leaves != y.leaves || x.depth != y.depth ||
            x.references != y.references || x.sah_cost != y.sah_cost)
            fail(fault::builds_differ,
                 fmt::format("nodes {} and {}, references {} and {}", x.nodes.value_or(0),
                             y.nodes.value_or(0), x.references, y.references));
    }

    const Builder& build_;
    Over test_;
    const SuiteOptions& options_;
    const TestScene* scene_ = nullptr;
    SuiteReport report_;
};

}  // namespace

std::string SuiteReport::text() const {
    std::string text = fmt::format("{} scenes, {} rays; exact oracle: {}\n", scenes,
                                   with_commas(rays), exact.text());
    if (naive_wrong)
        text += fmt::format("  {} other answers than the naive ones, which are wrong\n",
                            with_commas(naive_wrong));
    for (const Failure& failure : failures) text += "  " + failure.text() + "\n";
    return text;
}

SuiteReport examine_accelerator(const Builder& build, Over test, const SuiteOptions& options) {
    return Examiner(build, test, options).run();
}

SuiteReport check_accelerator(std::string_view name, const Builder& build, Over test,
                              const SuiteOptions& options) {
    SuiteReport report = examine_accelerator(build, test, options);
    fmt::print("{}: {}", name, report.text());
    for (const Failure& failure : report.failures)
        FAIL_CHECK(std::string(name) << ": " << failure.text());
    CHECK(report.scenes == options.scenes.size());
    return report;
}

}  // namespace space
