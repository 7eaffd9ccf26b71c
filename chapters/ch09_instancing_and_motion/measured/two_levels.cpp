#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/offset_origin.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/measured/instanced.hpp"
#include "chapters/ch09_instancing_and_motion/random_placement.hpp"
#include "common/measure.hpp"
#include "common/program/error.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space::ch09 {
namespace {

constexpr InstancedWay local_leaves{.leaf = LeafTest::local};

/// Turned at random, in the places of a cubic lattice of this spacing.
SceneGraph lattice_of(const std::string& name, std::vector<Triangle> triangles, int side,
                      double spacing, std::uint64_t seed) {
    const Aabb box = bounds(triangles);
    const double step = spacing * glm::length(Double3(box.extent()));
    std::vector<Instance> instances;
    Pcg32 random(seed);
    for (int i = 0; i < side * side * side; ++i) {
        ObjectPlacement placement{.rotation = random_rotation(random)};
        const Double3 place(i % side, i / side % side, i / (side * side));
        placement.translation = step * place - affine(placement).vector(Double3(box.centroid()));
        instances.push_back({affine(placement), 0});
    }
    return {{{.name = name, .triangles = std::move(triangles)},
             {.name = "lattice", .instances = std::move(instances)}},
            1};
}

using FlatTree = Bvh<BinnedBuilder>;

/// One from each point that the rays hit, about the normal on their side, as light is scattered.
std::vector<Ray> scattered(std::span<const Ray> rays, const FlatTree& tree,
                           std::span<const Triangle> triangles, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Ray> all;
    for (const Ray& ray : rays) {
        const auto hit = closest_hit(tree, ray);
        if (!hit) continue;
        const Triangle& triangle = triangles[hit->triangle];
        Double3 n = glm::normalize(normal(triangle));
        if (glm::dot(n, Double3(ray.direction)) > 0.0) n = -n;
        const Vector3 direction(n + random_direction(random));
        all.push_back({.origin = offset_origin(triangle, *hit, n), .direction = direction});
    }
    return all;
}

LevelsCost cost_of(const FlatTree& flat, const InstancedTrees& trees, std::span<const Ray> rays,
                   int rounds) {
    LevelsCost cost{.rays = rays.size()};
    TraversalCounts flat_counts, counts;
    for (const Ray& ray : rays) {
        const auto wanted = flat.closest_hit(ray, flat_counts);
        const auto hit = closest_placed_hit(trees, ray, counts);
        cost.differ +=
            wanted.has_value() != hit.has_value() ||
            (hit && *hit != PlacedHit{wanted->t, wanted->u, wanted->v, wanted->triangle});
    }
    cost.flat_nodes = flat_counts.nodes_visited;
    cost.flat_tests = flat_counts.triangles_tested;
    cost.nodes = counts.nodes_visited;
    cost.tests = counts.triangles_tested;
    if (rounds == 0) return cost;
    NoCounts none;
    const std::array<std::function<void()>, 3> runs{
        [&] {
            for (const Ray& ray : rays) do_not_optimize(flat.closest_hit(ray, none));
        },
        [&] {
            for (const Ray& ray : rays)
                do_not_optimize(closest_placed_hit<FilteredExact, local_leaves>(trees, ray, none));
        },
        [&] {
            for (const Ray& ray : rays) do_not_optimize(closest_placed_hit(trees, ray, none));
        }};
    const std::vector<double> ms = interleaved_medians(runs, rounds);
    const double ns = 1e6 / double(rays.size());
    cost.flat_ns = ns * ms[0];
    cost.local_ns = ns * ms[1];
    cost.world_ns = ns * ms[2];
    return cost;
}

LevelsPoint measure_lattice(const std::string& name, const std::vector<Triangle>& triangles,
                            int side, double spacing, std::size_t rays, int rounds,
                            std::uint64_t seed) {
    const SceneGraph graph = lattice_of(name, triangles, side, spacing, seed);
    const std::vector<Triangle> flat = flatten(graph);
    const FlatTree tree = FlatTree::build(flat);
    const InstancedTrees trees = InstancedTrees::build(graph);
    const std::vector<Ray> around = rays_from_around(flat, rays, seed);
    const std::vector<Ray> diffuse = scattered(around, tree, flat, seed);
    return {.object = name,
            .spacing = spacing,
            .instances = graph.object(1).instances.size(),
            .triangles = flat.size(),
            .flat_bytes = tree.shape().bytes,
            .bytes = trees.bytes(),
            .from_around = cost_of(tree, trees, around, rounds),
            .diffuse = cost_of(tree, trees, diffuse, rounds)};
}

/// An object, and how many times along each axis it stands, at most.
struct LatticeObject {
    std::string name;
    int most;
};

/// Nothing for a file that this machine does not have.
std::vector<Triangle> triangles_if_there(const std::string& name, std::uint64_t seed) {
    try {
        return make_scene(name, seed).mesh.triangles();
    } catch (const Error&) {
        return {};
    }
}

}  // namespace

std::vector<LevelsPoint> measure_levels(const Options& options) {
    if (options.counts) return {};  // the text quotes times of them, and checks answers in full
    const Amount amount = options.amount();
    const bool timed = amount != Amount::small;
    const std::size_t rays = amount == Amount::small ? 500 : 20'000;
    std::vector<LatticeObject> objects{{"icosphere:22", 4}, {"stadium", 4}};
    if (amount == Amount::small) objects = {{"icosphere:7", 2}};
    if (amount == Amount::full)
        objects.insert(objects.end(), {{"bunny", 4}, {"dragon_48k", 4}, {"dragon_871k", 2}});
    const int rounds = timed ? 3 : 0;
    std::vector<LevelsPoint> all;
    Progress progress("two levels", objects.size());
    for (const auto& [name, most] : objects) {
        const std::vector<Triangle> triangles = triangles_if_there(name, options.seed);
        for (int side = 1; side <= most && !triangles.empty(); ++side)
            all.push_back(measure_lattice(name, triangles, side, 0.6, rays, rounds, options.seed));
        if (most >= 3 && !triangles.empty())  // boxes that overlap much
            all.push_back(measure_lattice(name, triangles, 3, 0.3, rays, rounds, options.seed));
        progress.step();
    }
    return all;
}

}  // namespace space::ch09
