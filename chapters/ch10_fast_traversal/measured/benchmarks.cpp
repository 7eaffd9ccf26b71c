/// Micro-benchmarks of chapter 10: a load that waits, single rays through the chapter's trees, and
/// several at once. Run ch10_benchmarks --benchmark_filter=ray
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch10_fast_traversal/compressed_bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/interleaved.hpp"
#include "chapters/ch10_fast_traversal/packets.hpp"
#include "chapters/ch10_fast_traversal/pointer_chase.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace {

using namespace space;

/// Items are loads; the argument is the working set in KB.
void load_that_waits(benchmark::State& state) {
    const auto circle = make_chase_circle(static_cast<std::size_t>(state.range(0)) * 16, 1);
    std::uint32_t at = 0;
    for (auto _ : state) at = chase(circle, 1'000, at);
    benchmark::DoNotOptimize(at);
    state.SetItemsProcessed(state.iterations() * 1'000);
}
BENCHMARK(load_that_waits)->RangeMultiplier(8)->Range(16, 64 << 10);

/// Items are rays.
template <class Tree>
void ray_alone(benchmark::State& state) {
    const std::vector<Triangle> triangles = make_scene("stadium").mesh.triangles();
    const auto tree = Tree::build(triangles);
    const std::vector<Ray> rays = rays_within(triangles, 4'096, 1);
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(closest_hit(tree, rays[i++ % rays.size()]));
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ray_alone<Bvh<BinnedBuilder>>);
BENCHMARK(ray_alone<WideBvh<4, BinnedBuilder>>);
BENCHMARK(ray_alone<FastBvh<>>);
BENCHMARK(ray_alone<CompressedBvh<>>);

/// Items are rays; the argument is how many are under way.
void rays_interleaved(benchmark::State& state) {
    const std::vector<Triangle> triangles = make_scene("soup:100000").mesh.triangles();
    const auto tree = FastBvh<>::build(triangles);
    const std::vector<Ray> rays = rays_within(triangles, 4'096, 1);
    for (auto _ : state)
        trace_interleaved(tree, std::span<const Ray>(rays), static_cast<unsigned>(state.range(0)),
                          ManyQuery::closest, [](std::size_t, const std::optional<Hit>& hit) {
                              benchmark::DoNotOptimize(hit);
                          });
    state.SetItemsProcessed(state.iterations() * std::ssize(rays));
}
BENCHMARK(rays_interleaved)->RangeMultiplier(2)->Range(1, 32);

/// Items are rays; the argument is the size of a packet.
void rays_in_packets(benchmark::State& state) {
    const Scene scene = make_scene("stadium");
    const auto tree = FastBvh<>::build(scene.mesh.triangles());
    constexpr int side = 64;
    const std::vector<Ray> pixels = camera_rays(PixelGrid(scene.camera, side, side));
    std::vector<Ray> rays;
    for (const std::uint32_t pixel : tiled_order(side, side, 8)) rays.push_back(pixels[pixel]);
    for (auto _ : state)
        trace_in_packets(tree, std::span<const Ray>(rays), static_cast<std::size_t>(state.range(0)),
                         ManyQuery::closest, [](std::size_t, const std::optional<Hit>& hit) {
                             benchmark::DoNotOptimize(hit);
                         });
    state.SetItemsProcessed(state.iterations() * std::ssize(rays));
}
BENCHMARK(rays_in_packets)->RangeMultiplier(2)->Range(4, 64);

}  // namespace
