#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch04_kd_trees/measured/careless.hpp"
#include "chapters/ch04_kd_trees/measured/measurements.hpp"
#include "common/parallel.hpp"
#include "common/program/error.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>

namespace space::ch04 {
namespace {

using Rule = KdTreeConfig::Rule;
using Straddlers = KdTreeConfig::Straddlers;
/// In the order of rule_names.
constexpr std::pair<Rule, Straddlers> rules[]{
    {Rule::middle, Straddlers::clip}, {Rule::median, Straddlers::clip},
    {Rule::sah, Straddlers::clip},    {Rule::sah, Straddlers::duplicate},
    {Rule::sah, Straddlers::keep},    {Rule::sah, Straddlers::split}};
constexpr std::size_t grown_rules = 3;
/// As a scene grows: larger trees at the median take up to half a minute each.
constexpr std::size_t most_at_median = 150'000;

/// Counts what a build looks at.
struct BuildCounter : NoObserver {
    TreePoint& point;

    explicit BuildCounter(TreePoint& counted) : point(counted) {}
    using NoObserver::observe;
    void observe(const SahCandidate&) { ++of_node_; }
    void observe(const KdBuilder<3>::Chosen& chosen) {
        const std::uint64_t size = chosen.references.size();
        point.placed += size;
        point.candidates += of_node_;
        if (of_node_ > 0) point.faces += 6 * size;
        if (chosen.depth == 0) point.root_candidates = of_node_;
        of_node_ = 0;
    }

  private:
    std::uint64_t of_node_ = 0;
};

/// What is built, and what the naive loop answers to the first of the rays.
struct TreeTask {
    std::string scene;
    std::vector<Triangle> triangles;
    std::vector<Ray> rays;
    std::vector<std::optional<Hit>> truth;

    TreeTask(std::string name, std::vector<Triangle> all, const Options& options)
        : scene(std::move(name)),
          triangles(std::move(all)),
          rays(rays_within(triangles, limits(options).rays, options.seed)),
          truth(std::min(rays.size(), most_tests / triangles.size())) {
        const auto naive = Naive<FilteredExact>::build(triangles);
        parallel_for(truth.size(), options.threads, 16,
                     [&](std::size_t i) { truth[i] = closest_hit(naive, rays[i]); });
    }

  private:
    static constexpr std::size_t most_tests = 30'000'000;
};

void count_rays(TreePoint& point, const TreeTask& task, const KdTree<>& tree) {
    TraversalCounts counts;
    for (std::size_t i = 0; i < task.rays.size(); ++i) {
        const std::optional<Hit> hit = tree.closest_hit(task.rays[i], counts);
        point.wrong += i < task.truth.size() && hit != task.truth[i];
    }
    point.rays = task.rays.size();
    point.checked = task.truth.size();
    point.nodes_visited = counts.nodes_visited;
    point.tests = counts.triangles_tested;
}

std::uint64_t tests_unmailed(const TreeTask& task, const KdTree<>& tree) {
    TraversalCounts counts;
    for (const Ray& ray : task.rays)
        nearest_by(WalkWithMargins(), tree.nodes(), task.triangles, ray, counts);
    return counts.triangles_tested;
}

/// One tree, counted, and timed once.
TreePoint measure_tree(const TreeTask& task, std::size_t rule, KdTree<>& tree) {
    TreePoint point{.scene = task.scene, .rule = std::string(rule_names[rule])};
    const KdTreeConfig config{.rule = rules[rule].first, .straddlers = rules[rule].second};
    BuildCounter counter(point);
    Stopwatch stopwatch;
    tree = KdTree<>::build(task.triangles, config, counter);
    point.build_ms = stopwatch.lap().count();
    const TreeShape shape = tree.shape();
    point.n = task.triangles.size();
    point.nodes = *shape.nodes;
    point.references = shape.references;
    point.depth = *shape.depth;
    point.cost = shape.sah_cost.value_or(0.0);
    count_rays(point, task, tree);
    point.tests_unmailed = tests_unmailed(task, tree);
    return point;
}

/// These rules' trees, times interleaved.
std::vector<TreePoint> measure_rules(const TreeTask& task, const std::vector<std::size_t>& these,
                                     const Options& options) {
    std::vector<TreePoint> points;
    std::vector<KdTree<>> trees(std::size(rules));
    std::vector<std::function<void()>> builds, traces;
    for (const std::size_t rule : these) {
        points.push_back(measure_tree(task, rule, trees[rule]));
        builds.push_back([&task, rule] {
            do_not_optimize(KdTree<>::build(
                task.triangles, {.rule = rules[rule].first, .straddlers = rules[rule].second}));
        });
        traces.push_back([&task, &tree = trees[rule]] {
            for (const Ray& ray : task.rays) do_not_optimize(closest_hit(tree, ray));
        });
    }
    const int rounds = limits(options).rounds;
    if (rounds == 0) return points;
    // A large tree's build takes so long that one is enough.
    const bool again = !options.small && task.triangles.size() <= 20'000;
    const auto build_ms = again ? interleaved_medians(builds, rounds) : std::vector<double>();
    const auto trace_ms = interleaved_medians(traces, rounds);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (again) points[i].build_ms = build_ms[i];
        points[i].trace_ms = trace_ms[i];
    }
    return points;
}

std::vector<std::string> tree_scenes(const Options& options) {
    if (options.small) return {"soup", "lattice", "stadium"};
    std::vector<std::string> names{options.scene};
    if (options.counts && options.quick) return names;
    names.insert(names.end(), {"soup:10000", "lattice", "stadium"});
    if (!options.quick) names.insert(names.end(), {"building", "bunny", "dragon_48k"});
    return names;
}

// --- growth ---

/// About 1,000 triangles to a million, in half decades; two of them to a third of a million.
struct GrowingScene {
    std::string_view name;
    std::vector<std::uint32_t> sizes;
};
const std::vector<GrowingScene>& growing_scenes() {
    static const std::vector<GrowingScene> scenes{
        {"icosphere", {7, 13, 22, 40, 71, 126, 224}},
        {"soup", {1'000, 3'162, 10'000, 31'623, 100'000, 316'228, 1'000'000}},
        {"boxes", {83, 263, 833, 2'635, 8'333, 26'352}},
        {"teapot", {3, 6, 11, 19, 34, 61}},
    };
    return scenes;
}
std::vector<Triangle> grown(std::string_view name, std::uint32_t size, const Options& options) {
    if (name == "teapot") return teapot(size).triangles();
    return make_scene(fmt::format("{}:{}", name, size), options.seed).mesh.triangles();
}

}  // namespace

std::vector<TreePoint> measure_trees(const Options& options) {
    const std::vector<std::string> scenes = tree_scenes(options);
    std::vector<std::size_t> all_rules(rule_names.size());
    std::iota(all_rules.begin(), all_rules.end(), 0u);
    std::vector<TreePoint> points;
    Progress progress("trees by rules", scenes.size());
    for (const std::string& name : scenes) {
        std::optional<Scene> scene;
        try {
            scene = make_scene(name, options.seed, options.small);
        } catch (const Error&) {  // a file that this machine does not have
            if (name == options.scene) throw;
            progress.step();
            continue;
        }
        const TreeTask task(name, scene->mesh.triangles(), options);
        for (TreePoint& point : measure_rules(task, all_rules, options))
            points.push_back(std::move(point));
        progress.step();
    }
    return points;
}

std::vector<Growth> measure_growth(const Options& options) {
    const Limits limit = limits(options);
    std::vector<Growth> all;
    Progress progress("growth", growing_scenes().size() * limit.sizes);
    for (const GrowingScene& scene : growing_scenes()) {
        std::vector<Growth> by_rule(grown_rules);
        for (const std::uint32_t size :
             std::span(scene.sizes).first(std::min(limit.sizes, scene.sizes.size()))) {
            const TreeTask task(std::string(scene.name), grown(scene.name, size, options), options);
            std::vector<std::size_t> these;
            for (std::size_t rule = 0; rule < grown_rules; ++rule)
                if (rules[rule].first != Rule::median || task.triangles.size() <= most_at_median)
                    these.push_back(rule);
            const auto points = measure_rules(task, these, options);
            for (std::size_t i = 0; i < these.size(); ++i) by_rule[these[i]].push_back(points[i]);
            progress.step();
        }
        all.insert(all.end(), by_rule.begin(), by_rule.end());
    }
    return all;
}

}  // namespace space::ch04
