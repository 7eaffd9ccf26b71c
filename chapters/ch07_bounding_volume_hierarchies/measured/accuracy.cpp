#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch02_intersection_tests/watertight.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/any_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/measurements.hpp"
#include "common/aimed_rays.hpp"
#include "common/measure.hpp"
#include "common/parallel.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace space::ch07 {
namespace {

using Answers = std::vector<std::optional<Hit>>;

/// From all around: a third at points of edges, a third at vertices, the others anywhere in the
/// box. Half of those that are aimed graze.
std::vector<Ray> aimed_rays(const std::vector<Triangle>& triangles, std::size_t count,
                            std::uint64_t seed) {
    std::vector<Ray> rays = rays_from_around(triangles, count, seed);
    Pcg32 random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 3 == 2) continue;
        const auto which = random.below(static_cast<std::uint32_t>(triangles.size()));
        const Triangle& triangle = triangles[which];
        Point3 aim = triangle.a;
        if (i % 3 == 1) aim += random.uniform(0.0f, 1.0f) * (triangle.b - triangle.a);
        rays[i].direction = aim - rays[i].origin;
        if (i % 6 < 3) graze(rays[i], aim, random);
    }
    return rays;
}

struct AimedTask {
    std::string scene;
    std::vector<Triangle> triangles;
    std::vector<Ray> rays;
    Answers truth;  ///< the naive loop's

    AimedTask(const std::string& name, const Options& options)
        : scene(name),
          triangles(make_scene(name, options.seed).mesh.triangles()),
          rays(aimed_rays(triangles, limits(options).aimed_rays, options.seed)),
          truth(rays.size()) {
        const auto naive = Naive<FilteredExact>::build(triangles);
        parallel_for(rays.size(), options.threads, 64,
                     [&](std::size_t i) { truth[i] = closest_hit(naive, rays[i]); });
    }
};

/// Made once: two measurements ask for them.
const std::vector<AimedTask>& aimed_tasks(const Options& options) {
    static const std::vector<AimedTask> tasks = [&] {
        std::vector<std::string> scenes{"icosphere:8", "boxes:100", "soup:2000",
                                        "stadium:2",   "slivers",   "lattice:1"};
        if (options.small) scenes = {"icosphere:4", "boxes:36"};
        std::vector<AimedTask> all;
        Progress progress("true answers", scenes.size());
        for (const std::string& name : scenes) {
            all.emplace_back(name, options);
            progress.step();
        }
        return all;
    }();
    return tasks;
}

// --- margins and triangle tests ---

/// Timed are so many times fewer rays, evenly from all and of each kind: not a multiple of 2 or 3.
constexpr std::size_t timed_share = 5;

template <class Test, BoxMargins margins>
void add_accuracy(const AimedTask& task, std::string_view name, std::vector<AccuracyPoint>& points,
                  std::vector<std::function<void()>>& traces) {
    using Tree = Bvh<BinnedBuilder, Test, BvhWay{.margins = margins}>;
    const auto tree = std::make_shared<const Tree>(Tree::build(task.triangles));
    AccuracyPoint point{.scene = task.scene,
                        .margins = margins == BoxMargins::none ? plain : conservative,
                        .test = name,
                        .n = task.triangles.size(),
                        .rays = task.rays.size()};
    for (std::size_t i = 0; i < task.rays.size(); ++i) {
        const std::optional<Hit> hit = closest_hit(*tree, task.rays[i]);
        const std::optional<Hit>& true_hit = task.truth[i];
        point.wrong += hit.has_value() != true_hit.has_value();
        point.other += hit && true_hit && hit->triangle != true_hit->triangle;
    }
    points.push_back(std::move(point));
    traces.push_back([&task, tree] {
        for (std::size_t i = 0; i < task.rays.size(); i += timed_share)
            do_not_optimize(closest_hit(*tree, task.rays[i]));
    });
}

template <BoxMargins margins>
void add_tests(const AimedTask& task, std::vector<AccuracyPoint>& points,
               std::vector<std::function<void()>>& traces) {
    add_accuracy<FilteredExact, margins>(task, exact_test, points, traces);
    add_accuracy<Watertight, margins>(task, watertight_test, points, traces);
    add_accuracy<MollerTrumboreFloat, margins>(task, float_test, points, traces);
}

}  // namespace

std::vector<AccuracyPoint> measure_accuracy(const Options& options) {
    const std::vector<AimedTask>& tasks = aimed_tasks(options);
    std::vector<AccuracyPoint> points;
    Progress progress("accuracy", tasks.size());
    for (const AimedTask& task : tasks) {
        std::vector<std::function<void()>> traces;
        const std::size_t first = points.size();
        add_tests<BoxMargins::conservative>(task, points, traces);
        add_tests<BoxMargins::none>(task, points, traces);
        if (limits(options).rounds > 0) {
            const auto medians = interleaved_medians(traces, limits(options).rounds);
            for (std::size_t i = 0; i < medians.size(); ++i)
                points[first + i].ms = timed_share * medians[i];
        }
        progress.step();
    }
    return points;
}

std::vector<ExactPoint> measure_exact(const Options& options) {
    const std::vector<AimedTask>& tasks = aimed_tasks(options);
    std::vector<ExactPoint> points;
    Progress progress("exact answers", tasks.size());
    for (const AimedTask& task : tasks) {
        for (const NamedBuilder& builder : builders()) {
            const auto tree = Bvh<AnyBuilder>::build(task.triangles, builder.config);
            std::vector<std::uint8_t> differs(task.rays.size());
            parallel_for(differs.size(), options.threads, 64, [&](std::size_t i) {
                differs[i] = closest_hit(tree, task.rays[i]) != task.truth[i] ||
                             any_hit(tree, task.rays[i]) != task.truth[i].has_value();
            });
            points.push_back({.scene = task.scene,
                              .builder = builder.name,
                              .n = task.triangles.size(),
                              .rays = task.rays.size(),
                              .wrong = static_cast<std::uint64_t>(std::ranges::count(differs, 1))});
        }
        progress.step();
    }
    return points;
}

}  // namespace space::ch07
