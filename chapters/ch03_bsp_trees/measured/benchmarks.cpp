/// Micro-benchmarks of chapter 3: a polygon against a plane and a cut in each grade, a corner
/// decided by the filter and without it, a ray against one plane and through a whole tree. Run
/// ch03_benchmarks --benchmark_filter=classify
#include "chapters/ch03_bsp_trees/measured/measurements.hpp"
#include "common/scene.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace space;
using namespace space::ch03;

/// Polygons and their planes, in no order that a branch could be predicted from.
struct Soup {
    std::vector<Triangle> triangles = make_scene("soup:1024").mesh.triangles();
    std::vector<SplitPlane<3>> planes;
    std::vector<Fragment<3>> fragments;

    Soup() {
        for (const Triangle& triangle : triangles) {
            planes.emplace_back(triangle);
            fragments.push_back(whole_polygon<3>(triangle, std::uint32_t(fragments.size())));
        }
    }
    Cutter<3> cutter(Grade grade) const {
        // A thickness as the builder's: eight roundings of coordinates up to 1.
        return {triangles, planes, grade,
                8.0 * (grade == Grade::ordered_double ? 0x1p-53 : 0x1p-24)};
    }
};
const Soup& soup() {
    static const Soup one;
    return one;
}

std::vector<Ray> camera_rays() {
    constexpr int side = 16;
    const Camera camera = make_scene("soup:1024").camera;
    return space::camera_rays({camera, side, side});
}

void classify(benchmark::State& state) {
    const Cutter<3> cutter = soup().cutter(Grade(state.range(0)));
    std::vector<int> sides;
    std::uint32_t i = 0;
    for (auto _ : state) {
        cutter.corner_sides(soup().fragments[i % 1024], soup().planes[i / 7 % 1024], sides);
        benchmark::DoNotOptimize(Cutter<3>::classify(sides));
        ++i;
    }
    state.SetLabel(std::string(grade_names[std::size_t(state.range(0))]));
}
BENCHMARK(classify)->DenseRange(0, 3);

void split(benchmark::State& state) {
    const Cutter<3> cutter = soup().cutter(Grade(state.range(0)));
    struct Cut {
        std::uint32_t fragment, plane;
        std::vector<int> sides;
    };
    std::vector<Cut> cuts;
    for (std::uint32_t fragment = 0; fragment < 64; ++fragment)
        for (std::uint32_t plane = 0; plane < 1024; ++plane) {
            Cut cut{fragment, plane, {}};
            cutter.corner_sides(soup().fragments[fragment], soup().planes[plane], cut.sides);
            if (Cutter<3>::classify(cut.sides) == PlaneSide::straddling) cuts.push_back(cut);
        }
    std::size_t i = 0;
    for (auto _ : state) {
        const Cut& cut = cuts[i++ % cuts.size()];
        benchmark::DoNotOptimize(
            cutter.split(soup().fragments[cut.fragment], cut.sides, cut.plane));
    }
    state.SetLabel(std::string(grade_names[std::size_t(state.range(0))]));
}
BENCHMARK(split)->DenseRange(0, 3);

void side_by_filter(benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            side_filter(soup().planes[i / 7 % 1024], Double3(soup().triangles[i % 1024][0]), 0.0));
        ++i;
    }
}
BENCHMARK(side_by_filter);

void side_by_whole_numbers(benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            exact_side<3>(soup().triangles[i / 7 % 1024], soup().triangles[i % 1024][0]));
        ++i;
    }
}
BENCHMARK(side_by_whole_numbers);

void ray_against_plane(benchmark::State& state) {
    const std::vector<Ray> rays = camera_rays();
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(cross_plane(rays[i % 256], soup().planes[i % 1024], 0.0, 10.0));
        ++i;
    }
}
BENCHMARK(ray_against_plane);

/// Items are nodes visited.
void ray_through_tree(benchmark::State& state) {
    const auto triangles = make_scene("soup:" + std::to_string(state.range(0))).mesh.triangles();
    const Bsp<> bsp = Bsp<>::build(triangles);
    const std::vector<Ray> rays = camera_rays();
    TraversalCounts counts;
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(bsp.closest_hit(rays[i++ % 256], counts));
    state.SetItemsProcessed(static_cast<std::int64_t>(counts.nodes_visited));
}
BENCHMARK(ray_through_tree)->RangeMultiplier(10)->Range(100, 100'000);

}  // namespace
