#include "chapters/ch03_bsp_trees/measured/measurements.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch03_bsp_trees/tiling.hpp"
#include "common/parallel.hpp"
#include "common/program/error.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace space::ch03 {
namespace {

/// Counts what goes where, node by node.
struct PlacedCounter : NoObserver {
    std::uint64_t count = 0, balanced = 0;

    using NoObserver::observe;
    void observe(const BspBuilder<3>::Chosen&) { end_of_node(); }
    void observe(const BspBuilder<3>::Placed& placed) {
        ++count;
        ++set_;
        front_ += placed.side == PlaneSide::front || placed.side == PlaneSide::straddling;
        back_ += placed.side == PlaneSide::back || placed.side == PlaneSide::straddling;
    }
    void end_of_node() {
        if (3 * std::max(front_, back_) <= 2 * set_) balanced += set_;
        set_ = front_ = back_ = 0;
    }

  private:
    std::uint64_t set_ = 0, front_ = 0, back_ = 0;
};

/// How many nodes a look-up of a point visits: as BspTree::locate does.
std::uint64_t nodes_of_lookup(const BspTree<3>& tree, const Point3& point) {
    std::uint64_t visited = 0;
    std::vector<std::uint32_t> to_visit{0};
    while (!to_visit.empty()) {
        const BspTree<3>::Node& node = tree.nodes[to_visit.back()];
        to_visit.pop_back();
        ++visited;
        const int side = tree.side_of(point, node);
        if (side >= 0 && node.front != tree.none) to_visit.push_back(node.front);
        if (side <= 0 && node.back != tree.none) to_visit.push_back(node.back);
    }
    return visited;
}

}  // namespace

Limits limits(Amount amount) {
    switch (amount) {
        case Amount::small:
            return {.sizes = 3,
                    .max_classified = 2'000'000,
                    .max_fragments = 20'000,
                    .rays = 100,
                    .edge_rays = 2'000,
                    .rounds = 1};
        case Amount::quick:
            return {.sizes = 5,
                    .max_classified = 20'000'000,
                    .max_fragments = 100'000,
                    .rays = 300,
                    .edge_rays = 20'000,
                    .rounds = 1};
        default:
            return {.sizes = 7,
                    .max_classified = 300'000'000,
                    .max_fragments = 1'500'000,
                    .rays = 1'000,
                    .edge_rays = 500'000,
                    .rounds = 3};
    }
}

TreeTask::TreeTask(std::string name, std::vector<Triangle> all, const Options& options)
    : scene(std::move(name)),
      triangles(std::move(all)),
      rays(rays_from_around(triangles, limits(options.amount()).rays, options.seed)) {
    const auto naive = Naive<FilteredExact>::build(triangles);
    truth.resize(rays.size());
    parallel_for(rays.size(), options.threads, 16,
                 [&](std::size_t i) { truth[i] = closest_hit(naive, rays[i]); });
}

TreePoint measure_tree(const TreeTask& task, const Method& method, std::size_t max_fragments,
                       std::uint64_t max_placed) {
    const BspConfig config{.splitter = method.splitter,
                           .straddlers = method.straddlers,
                           .max_fragments = max_fragments,
                           .max_placed = max_placed};
    PlacedCounter counter;
    Stopwatch stopwatch;
    const auto bsp = Bsp<>::build(task.triangles, config, counter);
    TreePoint point{.scene = task.scene, .method = std::string(method.name)};
    point.build_ms = stopwatch.lap().count();
    point.polygons = task.triangles.size();
    point.nodes = bsp.tree().nodes.size();
    point.fragments = bsp.tree().fragments.size();
    point.depth = bsp.tree().depth();
    counter.end_of_node();
    point.placed = counter.count;
    point.placed_balanced = counter.balanced;
    for (const Ray& ray : task.rays) {
        ++point.lookups;
        point.lookup_nodes += nodes_of_lookup(bsp.tree(), ray.at(1.0f));
    }

    std::vector<std::uint64_t> pieces(task.triangles.size());
    for (const Fragment<3>& fragment : bsp.tree().fragments)
        point.most_pieces = std::max(point.most_pieces, ++pieces[fragment.polygon]);

    TraversalCounts counts;
    for (std::size_t i = 0; i < task.rays.size(); ++i)
        point.wrong += bsp.closest_hit(task.rays[i], counts) != task.truth[i];
    point.rays = task.rays.size();
    point.nodes_visited = counts.nodes_visited;
    point.triangles_tested = counts.triangles_tested;
    return point;
}

// -------------------------------------------------------------------------------------------------
// Scenes of one size

MethodTrees measure_methods(const std::string& scene, const Options& options) {
    const TreeTask task(scene, make_scene(scene, options.seed, options.small).mesh.triangles(),
                        options);
    MethodTrees result{.scene = scene};
    Progress progress("trees of " + scene, methods.size());
    for (const Method& method : methods) {
        try {
            result.trees.push_back(
                measure_tree(task, method, max_scene_fragments, max_scene_placed));
        } catch (const LimitError& error) {
            result.given_up.push_back(fmt::format("{}: {}", method.name, error.what()));
        }
        progress.step();
    }
    return result;
}

std::vector<TreePoint> measure_scenes(const Options& options) {
    std::vector<const char*> scenes{"stadium"};
    if (!options.small) scenes.insert(scenes.end(), {"sphereflake", "lattice", "building:1"});
    if (!options.small && !options.quick) scenes.insert(scenes.end(), {"bunny", "dragon_48k"});
    std::vector<TreePoint> points;
    Progress progress("trees of scenes", 3 * scenes.size());
    for (const char* name : scenes) {
        std::optional<Scene> scene;
        try {
            scene = make_scene(name, options.seed, options.small);
        } catch (const Error&) {  // a file that this machine does not have
            progress.step(3);
            continue;
        }
        const TreeTask task(name, scene->mesh.triangles(), options);
        for (const Method& method : methods)
            if (method.name == "weighted" || method.name == "free" || method.name == "shared") {
                points.push_back(measure_tree(task, method, max_scene_fragments, max_scene_placed));
                progress.step();
            }
    }
    return points;
}

// -------------------------------------------------------------------------------------------------
// Rays across planes

namespace {

/// The sign of a slope, 0 where double can't tell: as in cross_plane.
int slope_sign(const Ray& ray, const SplitPlane<3>& plane) {
    const Double3 direction(ray.direction);
    const double slope = glm::dot(plane.normal, direction);
    const double error = sum_roundings * plane.size * one_norm<3>(direction);
    return std::abs(slope) <= error ? 0 : slope > 0.0 ? 1 : -1;
}

}  // namespace

std::vector<Crossings> measure_crossings(const Options& options) {
    std::vector<Crossings> all;
    for (const char* name : {"soup", "stadium", "lattice"}) {
        const Scene scene = make_scene(name, options.seed, options.small);
        const std::vector<Triangle> triangles = scene.mesh.triangles();
        const auto bsp = Bsp<>::build(triangles);
        const BspTree<3>& tree = bsp.tree();
        Crossings crossings{.scene = name};
        TraversalCounts counts;
        for (const Ray& ray :
             rays_from_around(triangles, limits(options.amount()).rays, options.seed)) {
            ++crossings.rays;
            front_to_back(tree, ray, counts, [&](const BspTree<3>::Node& node) {
                const int side = tree.side_of(ray.origin, node);
                const int slope = slope_sign(ray, tree.planes[node.plane]);
                ++crossings.crossed;
                crossings.both += node.front != tree.none && node.back != tree.none;
                crossings.undecided += slope == 0;
                crossings.contradicted += slope != 0 && side == slope;  // leads away from the plane
                return double{infinity};
            });
        }
        crossings.visits = counts.nodes_visited;
        all.push_back(crossings);
    }
    return all;
}

// -------------------------------------------------------------------------------------------------
// The four grades

std::vector<GradePoint> measure_grades(const Options& options) {
    const Limits limit = limits(options.amount());
    std::vector<const char*> scenes{options.small ? "lattice" : "lattice:2"};
    if (!options.small) scenes.emplace_back("sphereflake");
    if (!options.small && !options.quick) scenes.emplace_back("bunny");
    std::vector<GradePoint> points;
    Progress progress("grades", grade_names.size() * scenes.size());
    for (const char* name : scenes) {
        std::optional<Scene> scene;
        try {
            scene = make_scene(name, options.seed, options.small);
        } catch (const Error&) {
            progress.step(grade_names.size());
            continue;
        }
        const std::vector<Triangle> polygons = scene->mesh.triangles();

        std::vector<std::function<void()>> builds;
        std::vector<BspTree<3>> trees(grades.size());
        for (std::size_t i = 0; i < grades.size(); ++i)
            builds.push_back(
                [&, i] { trees[i] = BspBuilder<3>::build(polygons, {.grade = grades[i]}); });
        const std::vector<double> build_ms =
            interleaved_medians(builds, options.counts ? 0 : limit.rounds);
        for (std::size_t i = 0; i < grades.size(); ++i) {
            const Tiling tiling = measure_tiling(trees[i], grades[i]);
            const FragmentRays rays(trees[i], grades[i]);
            const SlippedRays at_edges = rays.at_old_edges(limit.edge_rays, options.seed),
                              at_cuts = rays.at_cuts(limit.edge_rays, options.seed);
            points.push_back({.scene = name,
                              .grade = std::string(grade_names[i]),
                              .polygons = polygons.size(),
                              .nodes = trees[i].nodes.size(),
                              .fragments = trees[i].fragments.size(),
                              .area_error = tiling.area_error,
                              .cuts = tiling.cuts,
                              .cracks = tiling.cracks,
                              .edge_rays = at_edges.rays,
                              .edge_slipped = at_edges.slipped,
                              .cut_rays = at_cuts.rays,
                              .cut_slipped = at_cuts.slipped,
                              .build_ms = build_ms[i]});
            trees[i] = {};
            progress.step();
        }
    }
    return points;
}

}  // namespace space::ch03
