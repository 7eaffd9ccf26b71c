/// Micro-benchmarks of chapter 8: builds by each method with 1 and 2 threads, and the steps of ours
/// that all threads make together. Run  ch08_benchmarks --benchmark_filter=build
#include "chapters/ch06_quadtrees_and_octrees/radix_sort.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch08_parallel_builds/asymmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/boxed_by_all.hpp"
#include "chapters/ch08_parallel_builds/parallel_morton_builder.hpp"
#include "chapters/ch08_parallel_builds/parallel_partition.hpp"
#include "chapters/ch08_parallel_builds/parallel_radix_sort.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"
#include "common/pcg32.hpp"
#include "common/scene.hpp"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace {

using namespace space;

std::vector<Triangle> soup(std::int64_t size) {
    return make_scene("soup:" + std::to_string(size)).mesh.triangles();
}

constexpr std::int64_t size = 200'000;
constexpr std::size_t chunk = 4'096;

unsigned threads_of(const benchmark::State& state) {
    return static_cast<unsigned>(state.range(0));
}

/// Items are triangles; the argument is the number of threads, here and below.
template <class Builder>
void build(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(size);
    typename Builder::Config config;
    if constexpr (requires { config.threads; }) config.threads = threads_of(state);
    for (auto _ : state) benchmark::DoNotOptimize(Builder::template build<3>(triangles, config));
    state.SetItemsProcessed(state.iterations() * size);
}
BENCHMARK(build<BinnedBuilder>)->Arg(1)->UseRealTime();
BENCHMARK(build<AsymmetricBuilder>)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(build<SymmetricBuilder>)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(build<QueueBuilder>)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(build<WorkStealingBuilder>)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(build<ParallelMortonBuilder>)->Arg(1)->Arg(2)->UseRealTime();

void box_by_all(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(size);
    WorkStealing threads(threads_of(state));
    for (auto _ : state) {
        const BoxedByAll<3> boxed(triangles, chunk, threads);
        benchmark::DoNotOptimize(boxed.all().data());
    }
    state.SetItemsProcessed(state.iterations() * size);
}
BENCHMARK(box_by_all)->Arg(1)->Arg(2)->UseRealTime();

/// Half of the references to each side; the copy of the unparted ones is in the time.
void partition_by_all(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(size);
    const std::vector<BvhReference<3>> all = boxed<3>(triangles);
    std::vector<BvhReference<3>> parted = all;
    WorkStealing threads(threads_of(state));
    for (auto _ : state) {
        parted = all;
        ParallelPartition(std::span(parted), chunk, threads)
            .run([](const BvhReference<3>& reference) { return reference.polygon % 2 == 0; });
        benchmark::DoNotOptimize(parted.data());
    }
    state.SetItemsProcessed(state.iterations() * size);
}
BENCHMARK(partition_by_all)->Arg(1)->Arg(2)->UseRealTime();

/// Codes of 63 bits; the copy of the unsorted ones is in the time.
void sort_by_all(benchmark::State& state) {
    Pcg32 random(1);
    std::vector<CodedIndex> all;
    for (std::uint32_t i = 0; i < size; ++i) {
        const std::uint64_t high = random.next(), low = random.next();
        all.push_back({(high << 32 | low) >> 1, i});
    }
    std::vector<CodedIndex> items = all, scratch = all;
    WorkStealing threads(threads_of(state));
    for (auto _ : state) {
        items = all;
        benchmark::DoNotOptimize(parallel_radix_sort(items, scratch, 16 * chunk, threads).data());
    }
    state.SetItemsProcessed(state.iterations() * size);
}
BENCHMARK(sort_by_all)->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
