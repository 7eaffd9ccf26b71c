/// Micro-benchmarks of chapter 9: what a ray pays to enter an instance, what a world triangle
/// costs beside a local one, rays through two levels, and a refit beside a build. Run
/// ch09_benchmarks --benchmark_filter=through
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"
#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_ray.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/random_placement.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace space;

/// A sphere so many times, turned, in a cube.
SceneGraph spheres(std::size_t count) {
    std::vector<Instance> instances;
    Pcg32 random(1);
    for (std::size_t i = 0; i < count; ++i)
        instances.push_back({affine(random_placement(random, 4.0, 1.5)), 0});
    return {{{.name = "sphere", .triangles = make_scene("icosphere:22").mesh.triangles()},
             {.name = "spheres", .instances = std::move(instances)}},
            1};
}

/// A ray's way into an instance's space, ready for the tree there.
void into_local_space(benchmark::State& state) {
    const SceneGraph graph = spheres(64);
    const InstancedTrees trees = InstancedTrees::build(graph);
    const Ray ray{{9, 8, 7}, {-1, -0.9f, -0.8f}};
    const LocalRay world(ray, trees.root().box());
    std::size_t i = 0;
    for (auto _ : state) {
        const PlacedInstance& instance = trees.root().instances[i++ % 64];
        const LocalRay local = world.within(instance, instance.world_margin);
        benchmark::DoNotOptimize(InstancedRay(local, ray.tmin, ray.tmax));
    }
}
BENCHMARK(into_local_space);

void triangle_as_it_is(benchmark::State& state) {
    const std::vector<Triangle> triangles = make_scene("icosphere:22").mesh.triangles();
    const Ray ray{{9, 8, 7}, {-1, -0.9f, -0.8f}};
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(FilteredExact::intersect(ray, triangles[i++ % 1'024]));
}
BENCHMARK(triangle_as_it_is);

void triangle_in_the_world(benchmark::State& state) {
    const std::vector<Triangle> triangles = make_scene("icosphere:22").mesh.triangles();
    const Affine to_world = spheres(1).object(1).instances[0].to_parent;
    const Ray ray{{9, 8, 7}, {-1, -0.9f, -0.8f}};
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(
            FilteredExact::intersect(ray, flattened(to_world, triangles[i++ % 1'024])));
}
BENCHMARK(triangle_in_the_world);

/// Items are rays.
template <LeafTest leaf>
void ray_through_instances(benchmark::State& state) {
    const SceneGraph graph = spheres(64);
    const InstancedTrees trees = InstancedTrees::build(graph);
    const std::vector<Ray> rays = rays_within(flatten(graph), 1'024, 1);
    NoCounts none;
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(closest_placed_hit<FilteredExact, InstancedWay{.leaf = leaf}>(
            trees, rays[i++ % rays.size()], none));
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ray_through_instances<LeafTest::local>);
BENCHMARK(ray_through_instances<LeafTest::world>);

/// Items are triangles.
void refit_tree(benchmark::State& state) {
    const std::vector<Triangle> triangles =
        make_scene("soup:" + std::to_string(state.range(0))).mesh.triangles();
    BvhNodes<3> tree = BinnedBuilder::build<3>(triangles);
    for (auto _ : state) {
        refit<3>(tree, triangles);
        benchmark::DoNotOptimize(tree.nodes.data());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(refit_tree)->Arg(1'000)->Arg(100'000);

}  // namespace
