/// @file
/// Something that answers rays, whatever its type: ours, and Embree's modes.
#pragma once

#include "chapters/ch10_fast_traversal/many_rays.hpp"
#include "chapters/ch10_fast_traversal/measured/traced_scene.hpp"
#include "common/accelerator.hpp"
#include "common/measure.hpp"
#include "common/parallel.hpp"

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {

/// The query that a kind of rays asks.
inline ManyQuery query_of(RayKind kind) {
    return kind == shadow_kind ? ManyQuery::any : ManyQuery::closest;
}

/// What may be asked of a tree that stands.
struct Tracer {
    std::string name;
    TreeShape shape = {};
    /// Traces rays, and forgets the answers: to be timed.
    std::function<void(std::span<const Ray>, ManyQuery)> trace;
    std::function<Answers(std::span<const Ray>, ManyQuery)> answers;
    /// The work behind that; none of others' code.
    std::function<TraversalCounts(std::span<const Ray>, ManyQuery)> count = {};
};

struct NothingAround {};

/// `Around` lives while rays are traced.
template <class Around = NothingAround, Accelerator A>
Tracer tracer_of(std::string name, std::shared_ptr<const A> tree) {
    return {.name = std::move(name),
            .shape = tree->shape(),
            .trace =
                [tree](std::span<const Ray> rays, ManyQuery query) {
                    [[maybe_unused]] const Around around;
                    if (query == ManyQuery::any)
                        for (const Ray& ray : rays) do_not_optimize(any_hit(*tree, ray));
                    else
                        for (const Ray& ray : rays) do_not_optimize(closest_hit(*tree, ray));
                },
            .answers =
                [tree](std::span<const Ray> rays, ManyQuery query) {
                    [[maybe_unused]] const Around around;
                    Answers all;
                    for (const Ray& ray : rays) all.push_back(single_answer(*tree, ray, query));
                    return all;
                }};
}

/// One of ours: it counts, too.
template <Accelerator A>
Tracer our_tracer(std::string name, A tree) {
    const auto shared = std::make_shared<const A>(std::move(tree));
    Tracer tracer = tracer_of(std::move(name), shared);
    tracer.count = [shared](std::span<const Ray> rays, ManyQuery query) {
        TraversalCounts counts;
        if (query == ManyQuery::any)
            for (const Ray& ray : rays) shared->any_hit(ray, counts);
        else
            for (const Ray& ray : rays) shared->closest_hit(ray, counts);
        return counts;
    };
    return tracer;
}

/// How many answers are not these: in any bit, or, to the question for any, in whether there is
/// one.
inline std::uint64_t differences(const Answers& got, const Answers& wanted, ManyQuery query) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        count += query == ManyQuery::any ? got[i].has_value() != wanted[i].has_value()
                                         : got[i] != wanted[i];
    return count;
}

/// The time of Embree's default build, in milliseconds of one thread; 0 where it is not installed.
double embree_build_ms(const std::vector<Triangle>& triangles);
/// The names.
inline constexpr std::string_view embree_default = "Embree", embree_robust = "Embree robust",
                                  embree_high = "Embree high";
/// Those of Embree that are asked for, by their names; none where it is not installed.
std::vector<Tracer> embree_tracers(const std::vector<Triangle>& triangles,
                                   std::initializer_list<std::string_view> names);

/// The processor's time of the calling thread: others who use the machine are not in it, but for
/// the caches that they fill.
inline double thread_ms() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

/// The same of all threads: libraries may build in threads of their own.
inline double process_ms() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

/// The median time of each, in milliseconds of the thread, run in turn after a round of warming up;
/// without it where they have just been run.
inline std::vector<double> thread_medians(std::span<const std::function<void()>> candidates,
                                          int rounds, bool are_warm = false) {
    std::vector<std::vector<double>> times(candidates.size());
    for (int round = are_warm ? 0 : -1; round < rounds; ++round)
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            const double before = thread_ms();
            candidates[i]();
            if (round >= 0) times[i].push_back(thread_ms() - before);
        }
    std::vector<double> medians;
    for (auto& series : times) medians.push_back(median(std::move(series)));
    return medians;
}

/// Nanoseconds of a ray of one kind by each tracer, interleaved; nothing for no rounds.
inline std::vector<double> ray_times(const std::vector<Tracer>& tracers, const TracedScene& scene,
                                     RayKind kind, int rounds) {
    const std::span<const Ray> rays = scene.rays[kind];
    if (rounds == 0 || rays.empty()) return std::vector<double>(tracers.size(), 0.0);
    std::vector<std::function<void()>> runs;
    for (const Tracer& tracer : tracers)
        runs.push_back([&tracer, rays, kind] { tracer.trace(rays, query_of(kind)); });
    std::vector<double> times = thread_medians(runs, rounds);
    for (double& ms : times) ms *= 1e6 / double(rays.size());
    return times;
}

}  // namespace space::ch10
