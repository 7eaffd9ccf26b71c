/// Micro-benchmarks of chapter 1: one ray-triangle test, and one ray against all triangles of a
/// soup. Run   ch01_benchmarks --benchmark_filter=closest
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/scene.hpp"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using namespace space;

constexpr int side = 32;  // rays per row and column of the picture

Scene soup(benchmark::State& state) {
    return make_scene("soup:" + std::to_string(state.range(0)));
}

void moller_trumbore(benchmark::State& state) {
    const Scene scene = make_scene("soup:1024");
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const std::vector<Ray> rays = camera_rays({scene.camera, side, side});
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            MollerTrumbore::intersect(rays[i % rays.size()], triangles[i % triangles.size()]));
        ++i;
    }
}
BENCHMARK(moller_trumbore);

template <bool any>
void naive(benchmark::State& state) {
    const Scene scene = soup(state);
    const Naive<> naive = Naive<>::build(scene.mesh.triangles());
    const std::vector<Ray> rays = camera_rays({scene.camera, side, side});
    std::size_t i = 0;
    for (auto _ : state) {
        const Ray& ray = rays[i++ % rays.size()];
        if constexpr (any)
            benchmark::DoNotOptimize(any_hit(naive, ray));
        else
            benchmark::DoNotOptimize(closest_hit(naive, ray));
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(naive<false>)->Name("closest_hit")->RangeMultiplier(10)->Range(100, 100'000);
BENCHMARK(naive<true>)->Name("any_hit")->RangeMultiplier(10)->Range(100, 100'000);

}  // namespace
