#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/linear_octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/measurements.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/pointer_octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"
#include "common/measure.hpp"
#include "common/parallel.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace space::ch06 {
namespace {

/// What is built, and what the naive loop answers to the first of the rays.
struct TreeTask {
    std::string scene;
    bool is_even;
    std::vector<Triangle> triangles;
    std::vector<Ray> rays;
    std::vector<std::optional<Hit>> truth;

    TreeTask(std::string name, bool even, std::vector<Triangle> all, const Options& options)
        : scene(std::move(name)),
          is_even(even),
          triangles(std::move(all)),
          rays(rays_within(triangles, limits(options).rays, options.seed)),
          truth(std::min(rays.size(), most_tests / triangles.size())) {
        const auto naive = Naive<FilteredExact>::build(triangles);
        parallel_for(truth.size(), options.threads, 16,
                     [&](std::size_t i) { truth[i] = closest_hit(naive, rays[i]); });
    }

    TreeTask(const std::string& name, bool even, const Options& options)
        : TreeTask(name, even, make_scene(name, options.seed).mesh.triangles(), options) {}

  private:
    static constexpr std::size_t most_tests = 10'000'000;
};

/// One way to build a tree and to ask it.
struct Variant {
    std::string_view name;
    /// Counts into the point; returns what shoots all rays.
    std::function<std::function<void()>(const TreeTask&, TreePoint&)> build;
};

/// Counts a tree that `make` builds, and shows it to `look`; the rays are shot by what is returned.
/// A short build is done three times: one interruption is as long.
template <class Make, class Look>
std::function<void()> built(const TreeTask& task, TreePoint& point, const Make& make,
                            const Look& look) {
    using Tree = decltype(make());
    constexpr double short_ms = 20.0;
    std::shared_ptr<const Tree> tree;
    std::vector<double> ms;
    do {
        tree.reset();
        Stopwatch stopwatch;
        tree = std::make_shared<const Tree>(make());
        ms.push_back(stopwatch.lap().count());
    } while (ms.size() < 3 && ms.back() < short_ms);
    point.build_ms = median(std::move(ms));
    const TreeShape shape = tree->shape();
    point.n = task.triangles.size();
    point.nodes = shape.nodes.value_or(0);
    point.references = shape.references;
    point.depth = shape.depth.value_or(0);
    point.bytes = shape.bytes;
    TraversalCounts counts;
    for (std::size_t i = 0; i < task.rays.size(); ++i) {
        const std::optional<Hit> hit = tree->closest_hit(task.rays[i], counts);
        point.wrong += i < task.truth.size() && hit != task.truth[i];
    }
    point.rays = task.rays.size();
    point.checked = task.truth.size();
    point.nodes_visited = counts.nodes_visited;
    point.tests = counts.triangles_tested;
    look(*tree);
    return [&task, tree] {
        for (const Ray& ray : task.rays) do_not_optimize(closest_hit(*tree, ray));
    };
}
template <class Make>
std::function<void()> built(const TreeTask& task, TreePoint& point, const Make& make) {
    return built(task, point, make, [](const auto&) {});
}

template <class Tree>
Variant variant(std::string_view name, const typename Tree::Config& config = {}) {
    return {name, [config](const TreeTask& task, TreePoint& point) {
                return built(task, point, [&] { return Tree::build(task.triangles, config); });
            }};
}

/// The plane parameters that an octree's walks compute: one for each axis of an inner node, or two
/// for each axis of a child.
struct PlaneCounter : NoObserver {
    const OrthtreeNodes<3>& nodes;
    std::uint64_t inner = 0, children = 0;

    explicit PlaneCounter(const OrthtreeNodes<3>& walked) : nodes(walked) {}
    using NoObserver::observe;
    void observe(const OrthtreeVisit<3>& visit) {
        const OrthtreeNode& node = nodes.nodes[visit.node];
        inner += !node.is_leaf();
        children += std::uint64_t(std::popcount(std::uint32_t{node.mask}));
    }
};

std::uint64_t planes_computed(const TreeTask& task, const Octree<>& tree, OctreeConfig::Walk walk) {
    PlaneCounter counter(tree.nodes());
    NoCounts none;
    for (const Ray& ray : task.rays)
        nearest_found([&](const auto& found) {
            double limit = infinity;
            const auto own = [&](std::uint32_t node) {
                for (const std::uint32_t triangle : tree.nodes().own(node))
                    if (auto hit = FilteredExact::intersect(ray, task.triangles[triangle])) {
                        hit->triangle = triangle;
                        limit = found(*hit);
                    }
                return limit;
            };
            walk_orthtree(tree.nodes(), walk, ray, none, own, counter);
        });
    return walk == OctreeConfig::Walk::plain ? 6 * counter.children : 3 * counter.inner;
}

Variant octree_walk(std::string_view name, OctreeConfig::Walk walk) {
    return {
        name, [walk](const TreeTask& task, TreePoint& point) {
            return built(
                task, point, [&] { return Octree<>::build(task.triangles, {.walk = walk}); },
                [&](const Octree<>& tree) { point.planes = planes_computed(task, tree, walk); });
        }};
}

using Straddlers = OctreeConfig::Straddlers;

std::vector<Variant> all_variants() {
    return {octree_walk(octree, OctreeConfig::Walk::parametric),
            octree_walk(plain_walk, OctreeConfig::Walk::plain),
            {pointers,
             [](const TreeTask& task, TreePoint& point) {
                 point.node_bytes = sizeof(PointerNode<3>);
                 return built(task, point, [&] { return PointerOctree(task.triangles); });
             }},
            variant<Octree<>>(kept, {.straddlers = Straddlers::keep}),
            variant<Octree<>>(loose, {.straddlers = Straddlers::keep, .looseness = 2.0}),
            variant<LinearOctree<>>(linear),
            variant<KdTree<>>(sah)};
}

/// All variants of one task, times interleaved.
std::vector<TreePoint> measure_variants(const TreeTask& task, std::span<const Variant> variants,
                                        const Options& options) {
    std::vector<TreePoint> points;
    std::vector<std::function<void()>> traces;
    for (const Variant& variant : variants) {
        TreePoint point{.scene = task.scene, .tree = variant.name, .is_even = task.is_even};
        if (variant.name == linear)
            point.node_bytes = sizeof(LinearOrthtree<3>::Node) + sizeof(Aabb);
        if (variant.name == octree) point.node_bytes = sizeof(OrthtreeNode);
        traces.push_back(variant.build(task, point));
        points.push_back(std::move(point));
    }
    const int rounds = limits(options).rounds;
    if (rounds == 0) return points;
    const std::vector<double> medians = interleaved_medians(traces, rounds);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].trace_ms = medians[i];
    return points;
}

struct NamedScene {
    std::string name;
    bool is_even;
};
std::vector<NamedScene> tree_scenes(const Options& options) {
    if (options.small) return {{"soup:1000", true}, {"stadium:2", false}};
    if (options.quick) return {{"soup:10000", true}, {"icosphere:22", true}, {"stadium", false}};
    return {{"soup:30000", true},
            {"icosphere:40", true},
            {"lattice", true},
            {"mount:7", true},
            {"stadium:20", false},
            {"tree:9", false},
            {"soup_uneven:30000", false},
            {"shells", false},
            {"building", false}};
}

/// What the naive loop takes: as many tests as there are triangles.
TreePoint without_tree(const TreeTask& task, const Options& options) {
    TreePoint point{.scene = task.scene, .tree = no_tree, .is_even = task.is_even};
    point.n = task.triangles.size();
    point.bytes = point.n * sizeof(Triangle);
    point.rays = std::min<std::size_t>(task.rays.size(), 3'000'000 / point.n);
    point.tests = point.rays * point.n;
    if (limits(options).rounds == 0) return point;
    const auto naive = Naive<FilteredExact>::build(task.triangles);
    Stopwatch stopwatch;
    for (std::size_t i = 0; i < point.rays; ++i) do_not_optimize(closest_hit(naive, task.rays[i]));
    point.trace_ms = stopwatch.lap().count();
    return point;
}

/// From about 1,000 triangles to 1,000,000: Haines' scenes by their size factors, and the soup.
struct GrowingScene {
    std::string_view name;
    std::vector<std::size_t> sizes;
};
const std::vector<GrowingScene>& growing_scenes() {
    static const std::vector<GrowingScene> scenes{
        {"soup", {1'000, 3'162, 10'000, 31'623, 100'000, 316'228, 1'000'000}},
        {"tetra", {5, 6, 7, 8, 9}},
        {"mount", {4, 5, 6, 7, 8}},
        {"tree", {4, 6, 8, 10}},
        {"lattice", {1, 2, 4, 6}},
        {"sphereflake", {1, 2, 3}},
        {"shells", {1, 2, 3}},
        {"stadium", {3, 6, 11, 19, 34}}};
    return scenes;
}

}  // namespace

std::vector<TreePoint> measure_trees(const Options& options) {
    const std::vector<Variant> variants = all_variants();
    const std::vector<NamedScene> scenes = tree_scenes(options);
    std::vector<TreePoint> points;
    Progress progress("trees", scenes.size());
    for (const NamedScene& scene : scenes) {
        const TreeTask task(scene.name, scene.is_even, options);
        for (TreePoint& point : measure_variants(task, variants, options))
            points.push_back(std::move(point));
        points.push_back(without_tree(task, options));
        progress.step();
    }
    return points;
}

std::vector<TreePoint> measure_growth(const Options& options) {
    const std::vector<Variant> variants{variant<Octree<>>(octree), variant<LinearOctree<>>(linear),
                                        variant<KdTree<>>(sah)};
    std::vector<TreePoint> points;
    Progress progress("growth", growing_scenes().size());
    for (const GrowingScene& scene : growing_scenes()) {
        for (const std::size_t size : scene.sizes) {
            const std::string name = fmt::format("{}:{}", scene.name, size);
            std::vector<Triangle> triangles = make_scene(name, options.seed).mesh.triangles();
            if (triangles.size() > limits(options).most_triangles) break;
            const TreeTask task(name, false, std::move(triangles), options);
            for (TreePoint& point : measure_variants(task, variants, options)) {
                point.scene = scene.name;
                points.push_back(std::move(point));
            }
        }
        progress.step();
    }
    return points;
}

std::vector<TreePoint> measure_depths(const Options& options) {
    std::vector<std::string> scenes{"soup:30000", "lattice", "stadium"};
    if (options.amount() == Amount::quick) scenes = {"soup:10000", "stadium"};
    if (options.small) scenes = {"soup:1000"};
    std::vector<TreePoint> points;
    Progress progress("depths", scenes.size());
    for (const std::string& scene : scenes) {
        const TreeTask task(scene, false, options);
        std::vector<Variant> variants;
        std::vector<std::uint32_t> depths;
        for (std::uint32_t depth = 3; depth <= 12; ++depth) {
            depths.push_back(depth);
            variants.push_back(variant<Octree<>>(octree, {.max_depth = depth}));
        }
        std::vector<TreePoint> all = measure_variants(task, variants, options);
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i].depth_limit = depths[i];
            points.push_back(std::move(all[i]));
        }
        progress.step();
    }
    return points;
}

}  // namespace space::ch06
