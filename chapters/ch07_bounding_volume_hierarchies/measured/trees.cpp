#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/any_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/embree_run.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/measurements.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/ray_task.hpp"
#include "common/program/error.hpp"
#include "common/program/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace space::ch07 {
namespace {

/// What is timed in turn.
struct Timed {
    bool with_peers = false;  ///< then the builds that are compared are timed again, however long
    std::vector<std::function<void()>> builds, traces;
    std::vector<double*> build_ms, trace_ms;  ///< where the medians go

    void add(TreePoint& point, std::function<void()> build,
             std::array<std::function<void()>, ray_kinds.size()> of_kinds) {
        // Another long build takes its one time from when the tree was made.
        const bool is_compared =
            with_peers && (point.builder == by_bins || point.builder == embree);
        if (point.build_ms < longest_again_ms || is_compared) {
            builds.push_back(std::move(build));
            build_ms.push_back(&point.build_ms);
        }
        for (std::size_t kind = 0; kind < of_kinds.size(); ++kind) {
            traces.push_back(std::move(of_kinds[kind]));
            trace_ms.push_back(&point.rays[kind].ms);
        }
    }
    void run(int rounds) const {
        const auto take = [](const auto& runs, const auto& places, int times) {
            const std::vector<double> medians = interleaved_medians(runs, times);
            for (std::size_t i = 0; i < medians.size(); ++i) *places[i] = medians[i];
        };
        take(builds, build_ms, std::min(rounds, 3));
        take(traces, trace_ms, rounds);
    }

  private:
    static constexpr double longest_again_ms = 100.0;
};

/// Traces all rays of a kind that has answers; those that are not the task's.
template <Accelerator A>
std::uint64_t differences(const A& tree, const std::vector<Ray>& rays, const Answers& answers,
                          TraversalCounts& counts) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
        count += tree.closest_hit(rays[i], counts) != answers[i];
    return count;
}

/// Builds and counts a tree; what is to be timed joins the others.
template <class Tree>
void measure_tree(const RayTask& task, const AnyBuilder::Config& config, TreePoint& point,
                  Timed& timed) {
    const auto build = [&task, config] { return Tree::build(task.triangles, config); };
    Stopwatch stopwatch;
    const auto tree = std::make_shared<const Tree>(build());
    point.build_ms = stopwatch.lap().count();
    const TreeShape shape = tree->shape();
    point.n = task.triangles.size();
    point.nodes = *shape.nodes;
    point.leaves = *shape.leaves;
    point.references = shape.references;
    point.depth = *shape.depth;
    point.bytes = shape.bytes;
    point.cost = tree->nodes().sah_cost({});
    std::uint64_t differ = 0;
    for (std::size_t kind = 0; kind < ray_kinds.size(); ++kind) {
        TraversalCounts counts;
        if (kind == shadow_kind)
            trace(*tree, task, kind, counts);
        else
            differ +=
                differences(*tree, task.rays[kind],
                            kind == camera_kind ? task.camera_hits : task.diffuse_hits, counts);
        point.rays[kind] = {.rays = task.rays[kind].size(),
                            .nodes = counts.nodes_visited,
                            .tests = counts.triangles_tested};
    }
    point.checked = task.checked;
    if (point.builder != bins_float) point.wrong = task.wrong + differ;
    timed.add(
        point, [build] { do_not_optimize(build()); }, runs(task, tree));
}

/// The task's trees by some builders, and by others' where times are taken.
std::vector<TreePoint> measure_builders(const RayTask& task, bool is_long, bool with_peers,
                                        std::span<const NamedBuilder> some,
                                        const Options& options) {
    std::vector<TreePoint> points;
    points.reserve(some.size() + 3);  // Timed points to them
    Timed timed;
    timed.with_peers = with_peers;
    const auto point_of = [&](std::string_view builder) -> TreePoint& {
        points.push_back({.scene = task.scene, .builder = builder});
        return points.back();
    };
    for (const NamedBuilder& builder : some)
        if (task.triangles.size() <= builder.most_triangles)
            measure_tree<Bvh<AnyBuilder>>(task, builder.config, point_of(builder.name), timed);
    if (with_peers && limits(options).rounds > 0) {
        measure_tree<Bvh<AnyBuilder, MollerTrumboreFloat>>(task, some.front().config,
                                                           point_of(bins_float), timed);
        for (PeerRun& run : embree_runs(task)) {
            points.push_back(run.point);
            for (std::size_t kind = 0; kind < ray_kinds.size(); ++kind)
                points.back().rays[kind].rays = task.rays[kind].size();
            timed.add(points.back(), std::move(run.build), std::move(run.traces));
        }
    }
    for (TreePoint& point : points) point.is_long = is_long;
    if (limits(options).rounds > 0) timed.run(limits(options).rounds);
    return points;
}

struct NamedScene {
    std::string name;
    bool is_long = false;
};
std::vector<NamedScene> tree_scenes(const Options& options) {
    if (options.small) return {{"soup:1000"}, {"stadium:2"}, {"slivers:300", true}};
    if (options.amount() == Amount::quick)
        return {{"soup:10000"}, {"icosphere:22"}, {"stadium"}, {"slivers:3000", true}};
    return {{"bunny"},          {"dragon_871k"},  {"conference", true}, {"forest"},
            {"icosphere:100"},  {"soup:1000000"}, {"stadium"},          {"mount:9"},
            {"building", true}, {"slivers", true}};
}

/// Nothing for a file that this machine does not have.
std::optional<Scene> scene_if_there(const std::string& name, const Options& options) {
    try {
        return make_scene(name, options.seed);
    } catch (const Error&) {
        return {};
    }
}

RayTask task_of(const std::string& name, const Scene& scene, const Options& options) {
    const Limits limit = limits(options);
    return {name,        scene, limit.width, limit.height, limit.naive_tests, options.threads,
            options.seed};
}

// --- growth ---

/// About 1,000 triangles to a million, in half decades.
struct GrowingScene {
    std::string_view name;
    std::vector<std::uint32_t> sizes;
};
const std::vector<GrowingScene>& growing_scenes() {
    static const std::vector<GrowingScene> all{
        {"icosphere", {7, 13, 22, 40, 71, 126, 224}},
        {"soup", {1'000, 3'162, 10'000, 31'623, 100'000, 316'228, 1'000'000}},
        {"mount", {4, 5, 6, 7, 8, 9}}};
    return all;
}

}  // namespace

std::vector<TreePoint> measure_trees(const Options& options) {
    const std::vector<NamedScene> scenes = tree_scenes(options);
    std::vector<TreePoint> points;
    Progress progress("trees", scenes.size());
    for (const auto& [name, is_long] : scenes) {
        if (const std::optional<Scene> scene = scene_if_there(name, options)) {
            const RayTask task = task_of(name, *scene, options);
            for (TreePoint& point : measure_builders(task, is_long, true, builders(), options))
                points.push_back(std::move(point));
        }
        progress.step();
    }
    return points;
}

std::vector<TreePoint> measure_growth(const Options& options) {
    std::vector<NamedBuilder> some;
    for (const NamedBuilder& builder : builders())
        if (builder.name == by_bins || builder.name == by_median || builder.name == by_morton ||
            builder.name == by_sweep)
            some.push_back(builder);
    std::vector<TreePoint> points;
    Progress progress("growth", growing_scenes().size());
    for (const auto& [name, sizes] : growing_scenes()) {
        for (const std::uint32_t size : sizes) {
            const Scene scene = make_scene(fmt::format("{}:{}", name, size), options.seed);
            if (scene.mesh.faces.size() > limits(options).most_triangles) break;
            const RayTask task = task_of(std::string(name), scene, options);
            for (TreePoint& point : measure_builders(task, false, false, some, options))
                points.push_back(std::move(point));
        }
        progress.step();
    }
    return points;
}

}  // namespace space::ch07
