/// Micro-benchmarks of chapter 5: a lazy tree that one ray enters, rays through one that stands, a
/// patch of a landscape. Run ch05_benchmarks --benchmark_filter=ray
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/heightfield.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <benchmark/benchmark.h>

#include <string>

namespace {

using namespace space;

std::vector<Triangle> soup(std::int64_t size) {
    return make_scene("soup:" + std::to_string(size)).mesh.triangles();
}

/// Items are triangles.
void first_ray(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(state.range(0));
    const Ray ray = rays_within(triangles, 1, 1).front();
    for (auto _ : state) {
        const auto tree = LazyKdTree<>::build(triangles);
        benchmark::DoNotOptimize(closest_hit(tree, ray));
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(first_ray)->RangeMultiplier(10)->Range(1'000, 100'000);

/// Items are nodes visited; all of them stand.
template <class Tree>
void ray_through_tree(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(state.range(0));
    const auto tree = Tree::build(triangles);
    if constexpr (requires { tree.build_all(); }) tree.build_all();
    const std::vector<Ray> rays = rays_within(triangles, 1'024, 1);
    TraversalCounts counts;
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(tree.closest_hit(rays[i++ % 1'024], counts));
    state.SetItemsProcessed(static_cast<std::int64_t>(counts.nodes_visited));
}
BENCHMARK(ray_through_tree<KdTree<>>)->RangeMultiplier(10)->Range(1'000, 100'000);
BENCHMARK(ray_through_tree<LazyKdTree<>>)->RangeMultiplier(10)->Range(1'000, 100'000);

/// Items are triangles.
void patch_of_landscape(benchmark::State& state) {
    const Heightfield field;
    std::uint32_t patch = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(field.triangles(patch++ % field.patches()).data());
    state.SetItemsProcessed(state.iterations() * field.patch_triangles());
}
BENCHMARK(patch_of_landscape);

}  // namespace
