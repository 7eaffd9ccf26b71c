#include "chapters/ch08_parallel_builds/measured/builds.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "chapters/ch08_parallel_builds/asymmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/measured/embree_build.hpp"
#include "chapters/ch08_parallel_builds/parallel_morton_builder.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"
#include "common/program/error.hpp"
#include "common/program/progress.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <thread>
#include <utility>

namespace space::ch08 {
namespace {

/// A way to build, as a value.
struct Method {
    std::string_view name;
    unsigned threads = 1;
    std::function<BvhNodes<3>(std::span<const Triangle>)> nodes = {};  ///< none of a peer
    std::function<void(std::span<const Triangle>)> build = {};         ///< all that rays need
    std::size_t most_triangles = 3'000'000;                            ///< or it takes too long
};

template <class Builder>
Method method(std::string_view name, unsigned threads, std::size_t most_triangles = 3'000'000) {
    typename Builder::Config config;
    if constexpr (requires { config.threads; }) config.threads = threads;
    return {name, threads,
            [config](std::span<const Triangle> triangles) {
                return Builder::template build<3>(triangles, config);
            },
            [config](std::span<const Triangle> triangles) {
                do_not_optimize(Bvh<Builder>::build(triangles, config));
            },
            most_triangles};
}

/// Until all have done it.
void at_once(int threads, const std::function<void()>& work) {
    std::vector<std::jthread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back(work);
    work();
}

/// Two sequential builders, each with a tree of its own.
Method two_builds() {
    return {.name = two_at_once, .threads = 2, .build = [](std::span<const Triangle> triangles) {
                at_once(2, [triangles] { do_not_optimize(Bvh<BinnedBuilder>::build(triangles)); });
            }};
}

std::vector<Method> parallel_methods(unsigned threads) {
    return {method<SymmetricBuilder>(symmetric, threads),
            method<AsymmetricBuilder>(asymmetric, threads), method<QueueBuilder>(by_queue, threads),
            method<WorkStealingBuilder>(ours, threads)};
}

/// Nothing for a file that this machine does not have; says so.
std::optional<std::vector<Triangle>> triangles_of(const std::string& name, const Options& options) {
    try {
        return make_scene(name, options.seed).mesh.triangles();
    } catch (const Error& error) {
        fmt::print(stderr, "left out: {}\n", error.what());
        return {};
    }
}

int rounds_of(const Options& options) {
    return options.amount() == Amount::quick ? 3 : 4;
}

/// Whether the method makes the sequential builder's tree, which measure_same_trees shows.
bool makes_the_same(const Method& method) {
    return std::ranges::count(std::array{symmetric, asymmetric, by_queue, ours}, method.name) > 0;
}

/// Times them in turn, each beside the first one, the sequential builder.
std::vector<BuildPoint> timed(const std::string& scene, std::span<const Triangle> triangles,
                              const std::vector<Method>& methods, int rounds) {
    std::vector<const Method*> some;
    for (const Method& method : methods)
        if (triangles.size() <= method.most_triangles) some.push_back(&method);
    std::vector<std::function<void()>> runs;
    for (const Method* method : some)
        runs.emplace_back([method, triangles] { method->build(triangles); });
    const std::vector<Times> times = interleaved_times(runs, rounds);
    std::vector<BuildPoint> points;
    for (std::size_t i = 0; i < some.size(); ++i) {
        const auto cost = [&] {
            if (makes_the_same(*some[i])) return points.front().cost;
            return some[i]->nodes ? some[i]->nodes(triangles).sah_cost(BvhCosts{}) : 0.0;
        };
        points.push_back({.scene = scene,
                          .method = some[i]->name,
                          .threads = some[i]->threads,
                          .n = triangles.size(),
                          .cost = cost(),
                          .ms = spread_of(times[i]),
                          .gain = ratio(times[0], times[i])});
    }
    return points;
}

// --- the same trees ---

bool is_same(const BvhNodes<3>& a, const BvhNodes<3>& b) {
    return a.depth == b.depth && a.references == b.references &&
           std::ranges::equal(a.nodes, b.nodes);
}

template <class Sequential>
void add_same(std::vector<SamePoint>& points, const std::string& scene,
              std::span<const Triangle> triangles, const std::vector<unsigned>& threads,
              const std::function<std::vector<Method>(unsigned)>& methods) {
    const BvhNodes<3> wanted = Sequential::template build<3>(triangles);
    const std::size_t first = points.size();
    for (const unsigned count : threads) {
        const std::vector<Method> some = methods(count);
        for (std::size_t i = 0; i < some.size(); ++i) {
            if (points.size() == first + i)
                points.push_back({.scene = scene,
                                  .method = some[i].name,
                                  .n = triangles.size(),
                                  .nodes = wanted.size(),
                                  .depth = wanted.depth,
                                  .cost = wanted.sah_cost(BvhCosts{}),
                                  .threads = threads});
            ++points[first + i].builds;
            points[first + i].other += !is_same(some[i].nodes(triangles), wanted);
        }
    }
}

// --- the ceiling ---

/// From a scene's timed builds, and copies of its triangles.
CeilingPoint ceiling(const std::vector<BuildPoint>& timed, std::span<const Triangle> triangles,
                     int rounds) {
    const auto copy = [triangles] {
        for (int i = 0; i < 2; ++i)
            do_not_optimize(std::vector<Triangle>(triangles.begin(), triangles.end()));
    };
    const std::function<void()> runs[]{copy, [&] { at_once(2, copy); }};
    const std::vector<Times> times = interleaved_times(runs, rounds);
    const auto doubled = [](Spread spread) {
        return Spread{2 * spread.median, 2 * spread.low, 2 * spread.high};
    };
    const BuildPoint& both = *std::ranges::find(timed, two_at_once, &BuildPoint::method);
    return {.scene = both.scene,
            .n = triangles.size(),
            .alone_ms = timed.front().ms,
            .both_ms = both.ms,
            .gain = doubled(both.gain),
            .copy_gain = doubled(ratio(times[0], times[1]))};
}

std::vector<std::string> scenes_like_published(const Options& options) {
    if (options.amount() == Amount::quick) return {"icosphere:40", "building:1"};
    return {"dragon_871k", "forest", "icosphere:300", "conference", "building:83"};
}

}  // namespace

std::vector<SamePoint> measure_same_trees(const Options& options) {
    const std::vector<std::string> scenes =
        options.small ? std::vector<std::string>{"soup:1000", "stadium:2", "slivers:300"}
                      : std::vector<std::string>{"soup:30000", "icosphere:40", "stadium", "slivers",
                                                 "building:1"};
    const std::vector<unsigned> threads =
        options.small ? std::vector<unsigned>{1, 2, 5} : std::vector<unsigned>{1, 2, 3, 4, 8, 16};
    std::vector<SamePoint> points;
    Progress progress("same trees", scenes.size());
    for (const std::string& scene : scenes) {
        const std::vector<Triangle> triangles = make_scene(scene, options.seed).mesh.triangles();
        add_same<BinnedBuilder>(points, scene, triangles, threads, parallel_methods);
        add_same<MortonBuilder>(points, scene, triangles, threads, [](unsigned count) {
            return std::vector{method<ParallelMortonBuilder>(parallel_morton, count)};
        });
        progress.step();
    }
    return points;
}

SceneBuilds measure_scenes(const Options& options) {
    // With one thread the published methods are the sequential builder.
    std::vector<Method> methods{method<BinnedBuilder>(sequential, 1), two_builds(),
                                method<WorkStealingBuilder>(ours, 1)};
    for (Method& some : parallel_methods(2)) methods.push_back(std::move(some));
    methods.push_back(method<ParallelMortonBuilder>(parallel_morton, 2));
    methods.push_back(method<MortonBuilder>(morton, 1));
    methods.push_back(method<SweepBuilder>(by_sweep, 1, 300'000));
    if (has_embree)
        for (const unsigned threads : {1u, 2u})
            methods.push_back({.name = embree,
                               .threads = threads,
                               .build = [threads](std::span<const Triangle> triangles) {
                                   build_with_embree(triangles, threads);
                               }});
    const std::vector<std::string> scenes = scenes_like_published(options);
    SceneBuilds measured;
    Progress progress("builds", scenes.size());
    for (const std::string& scene : scenes) {
        if (const auto triangles = triangles_of(scene, options)) {
            const int rounds = rounds_of(options);
            std::vector<BuildPoint> points = timed(scene, *triangles, methods, rounds);
            measured.ceilings.push_back(ceiling(points, *triangles, rounds));
            std::ranges::move(points, std::back_inserter(measured.points));
        }
        progress.step();
    }
    return measured;
}

std::vector<BuildPoint> measure_build_growth(const Options& options) {
    std::vector<Method> methods{method<BinnedBuilder>(sequential, 1)};
    for (const unsigned threads : {1u, 2u}) {
        methods.push_back(method<WorkStealingBuilder>(ours, threads));
        methods.push_back(method<QueueBuilder>(by_queue, threads));
    }
    std::vector<std::uint32_t> sizes{7, 13, 22, 40, 71, 126, 224};
    if (options.amount() == Amount::quick) sizes.resize(4);
    std::vector<BuildPoint> points;
    Progress progress("growth of builds", sizes.size());
    for (const std::uint32_t size : sizes) {
        const std::vector<Triangle> triangles =
            make_scene(fmt::format("icosphere:{}", size), options.seed).mesh.triangles();
        for (BuildPoint& point : timed("icosphere", triangles, methods, rounds_of(options)))
            points.push_back(std::move(point));
        progress.step();
    }
    return points;
}

BuildMeasurements measure_builds(const Options& options) {
    BuildMeasurements measured;
    measured.same = measure_same_trees(options);
    if (options.small || options.counts) return measured;
    measured.scenes = measured_once<measure_scenes>(options).points;
    measured.ceilings = measured_once<measure_scenes>(options).ceilings;
    measured.growth = measured_once<measure_build_growth>(options);
    return measured;
}

}  // namespace space::ch08
