/// Micro-benchmarks of chapter 7: builds by each builder, a ray against a box, a ray through a
/// whole tree, and a copy of memory, which the builds are beside. Run
/// ch07_benchmarks --benchmark_filter=build
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <benchmark/benchmark.h>

#include <cstring>
#include <string>
#include <vector>

namespace {

using namespace space;

std::vector<Triangle> soup(std::int64_t size) {
    return make_scene("soup:" + std::to_string(size)).mesh.triangles();
}

/// Items are triangles.
template <class Builder>
void build(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(Builder::template build<3>(triangles));
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(build<MedianBuilder>)->Arg(1'000)->Arg(100'000);
BENCHMARK(build<MortonBuilder>)->Arg(1'000)->Arg(100'000);
BENCHMARK(build<BinnedBuilder>)->Arg(1'000)->Arg(100'000);
BENCHMARK(build<SweepBuilder>)->Arg(1'000)->Arg(100'000);
BENCHMARK(build<SpatialSplitBuilder>)->Arg(1'000)->Arg(100'000);

/// Both children of a node, as the walk has them.
void ray_against_pair(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(1'024);
    const BvhNodes<3> tree = BinnedBuilder::build<3>(triangles);
    const BvhRay<3> ray(rays_within(triangles, 1, 1).front());
    std::size_t pair = 2;
    for (auto _ : state) {
        benchmark::DoNotOptimize(ray.span_in(tree.nodes[pair].box, ray.limit()));
        benchmark::DoNotOptimize(ray.span_in(tree.nodes[pair + 1].box, ray.limit()));
        pair = pair + 2 < tree.nodes.size() ? pair + 2 : 2;
    }
}
BENCHMARK(ray_against_pair);

/// Items are nodes visited.
void ray_through_tree(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(state.range(0));
    const auto tree = Bvh<BinnedBuilder>::build(triangles);
    const std::vector<Ray> rays = rays_within(triangles, 1'024, 1);
    TraversalCounts counts;
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(tree.closest_hit(rays[i++ % 1'024], counts));
    state.SetItemsProcessed(static_cast<std::int64_t>(counts.nodes_visited));
}
BENCHMARK(ray_through_tree)->RangeMultiplier(10)->Range(1'000, 1'000'000);

/// Bytes are those read and those written.
void copy_memory(benchmark::State& state) {
    const auto size = static_cast<std::size_t>(state.range(0));
    const std::vector<char> from(size, 'a');
    std::vector<char> to(size);
    for (auto _ : state) {
        std::memcpy(to.data(), from.data(), size);
        benchmark::DoNotOptimize(to.data());
        benchmark::ClobberMemory();
    }
    state.SetBytesProcessed(2 * state.iterations() * state.range(0));
}
BENCHMARK(copy_memory)->Arg(1 << 15)->Arg(1 << 20)->Arg(1 << 27);

}  // namespace
