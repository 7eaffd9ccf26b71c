/// Micro-benchmarks of chapter 11: numbers, directions, points of lights, a path, a photon, and
/// what a look into a photon map or a cache costs. Run ch11_benchmarks --benchmark_filter=path
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/photon_map.hpp"
#include "chapters/ch11_sampling_and_caching/photon_tracing.hpp"
#include "chapters/ch11_sampling_and_caching/radiance_cache.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/camera.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace space;

template <SamplePattern pattern>
void pair_of_numbers(benchmark::State& state) {
    Sampler sampler(pattern, 64, 1);
    std::uint32_t sample = 0;
    for (auto _ : state) {
        sampler.start(0, sample++ % 64);
        benchmark::DoNotOptimize(sampler.next_pair());
    }
}
BENCHMARK(pair_of_numbers<SamplePattern::independent>);
BENCHMARK(pair_of_numbers<SamplePattern::stratified>);
BENCHMARK(pair_of_numbers<SamplePattern::sobol>);

void cosine_direction(benchmark::State& state) {
    Sampler sampler(SamplePattern::independent, 1, 1);
    for (auto _ : state)
        benchmark::DoNotOptimize(cosine_hemisphere({0, 1, 0}, sampler.next_pair()));
}
BENCHMARK(cosine_direction);

/// The box, with what asks it.
struct LitBox {
    LitScene lit = make_lit_scene("box");
    LightTable lights{lit};
    FastBvh<> tree = FastBvh<>::build(lit.triangles);
    std::vector<Ray> rays = camera_rays(PixelGrid(lit.scene.camera, 32, 24));
};

template <auto sample_light>
void point_of_a_light(benchmark::State& state) {
    const LitBox box;
    Sampler sampler(SamplePattern::independent, 1, 1);
    for (auto _ : state) {
        const double choice = sampler.next();
        benchmark::DoNotOptimize(
            sample_light(box.lights, Double3(0.5, 0.1, 0.5), choice, sampler.next_pair()));
    }
}
BENCHMARK(point_of_a_light<sample_light_area>);
BENCHMARK(point_of_a_light<sample_light_solid_angle>);

/// Items are samples.
void path(benchmark::State& state) {
    const LitBox box;
    Sampler sampler(SamplePattern::sobol, 64, 1);
    std::size_t i = 0;
    for (auto _ : state) {
        sampler.start(i % box.rays.size(), static_cast<std::uint32_t>(i / box.rays.size()));
        benchmark::DoNotOptimize(
            path_radiance(box.tree, box.lit, box.lights, box.rays[i++ % box.rays.size()], sampler));
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(path);

/// Items are photons that are emitted.
void photons(benchmark::State& state) {
    const LitBox box;
    for (auto _ : state)
        benchmark::DoNotOptimize(
            trace_photons(box.tree, box.lit, box.lights, {.count = 10'000}).photons.data());
    state.SetItemsProcessed(state.iterations() * 10'000);
}
BENCHMARK(photons);

void density_of_photons(benchmark::State& state) {
    const LitBox box;
    const PhotonMap map =
        PhotonMap::build(trace_photons(box.tree, box.lit, box.lights, {.count = 100'000}).photons);
    DensityEstimator density(map, {.k = static_cast<std::size_t>(state.range(0))});
    std::size_t i = 0;
    for (auto _ : state) {
        const Photon& at = map.photons[7'919 * i++ % map.photons.size()];
        benchmark::DoNotOptimize(density.irradiance(Double3(at.position), Double3(at.normal)));
    }
}
BENCHMARK(density_of_photons)->Arg(30)->Arg(400);

void look_into_a_cache(benchmark::State& state) {
    const LitBox box;
    const IrradianceCache cache =
        fill_cache(box.tree, box.lit, box.lights, PixelGrid(box.lit.scene.camera, 64, 48),
                   {.grid = {4, 12}}, 1);
    std::size_t i = 0;
    for (auto _ : state) {
        const IrradianceRecord& at = cache.records()[i++ % cache.records().size()];
        benchmark::DoNotOptimize(
            cache.irradiance(at.position + 0.01 * Basis(at.normal).x, at.normal));
    }
}
BENCHMARK(look_into_a_cache);

}  // namespace
