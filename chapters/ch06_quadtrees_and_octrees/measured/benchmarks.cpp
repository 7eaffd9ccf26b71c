/// Micro-benchmarks of chapter 6: codes, their sort, builds, a triangle and a cell, a ray through a
/// whole tree. Run ch06_benchmarks --benchmark_filter=build
#include "chapters/ch06_quadtrees_and_octrees/linear_octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/radix_sort.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <benchmark/benchmark.h>

#include <string>

namespace {

using namespace space;

std::vector<Triangle> soup(std::int64_t size) {
    return make_scene("soup:" + std::to_string(size)).mesh.triangles();
}
std::vector<CodedIndex> coded_points(std::int64_t size) {
    Pcg32 random(1);
    std::vector<CodedIndex> items;
    for (std::uint32_t i = 0; i < std::uint32_t(size); ++i)
        items.push_back({morton_code(OrthtreeFrame<3>(), random_point(random, 0.0f, 1.0f)), i});
    return items;
}

void code_of_point(benchmark::State& state) {
    Pcg32 random(1);
    std::vector<Point3> points;
    for (int i = 0; i < 1'024; ++i) points.push_back(random_point(random, 0.0f, 1.0f));
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(morton_code(OrthtreeFrame<3>(), points[i++ % 1'024]));
}
BENCHMARK(code_of_point);

void sort_codes(benchmark::State& state) {
    const std::vector<CodedIndex> coded = coded_points(state.range(0));
    std::vector<CodedIndex> items, scratch;
    for (auto _ : state) {
        items = coded;
        benchmark::DoNotOptimize(radix_sort(items, scratch));
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(sort_codes)->RangeMultiplier(10)->Range(1'000, 1'000'000);

/// Items are triangles.
template <class Tree>
void build(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(Tree::build(triangles));
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(build<Octree<>>)->RangeMultiplier(10)->Range(1'000, 100'000);
BENCHMARK(build<LinearOctree<>>)->RangeMultiplier(10)->Range(1'000, 100'000);

void triangle_in_cell(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(1'024);
    const OrthtreeFrame<3> frame;
    std::size_t i = 0;
    for (auto _ : state) {
        const Triangle& triangle = triangles[i++ % 1'024];
        const OrthtreeCell<3> cell = frame.cell_of(bounds(triangle).centroid(), 5);
        benchmark::DoNotOptimize(SimplexOverlap<3>(triangle).overlaps(frame.box(cell)));
    }
}
BENCHMARK(triangle_in_cell);

/// Items are nodes visited.
template <class Tree>
void ray_through_tree(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(state.range(0));
    const auto tree = Tree::build(triangles);
    const std::vector<Ray> rays = rays_within(triangles, 1'024, 1);
    TraversalCounts counts;
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(tree.closest_hit(rays[i++ % 1'024], counts));
    state.SetItemsProcessed(static_cast<std::int64_t>(counts.nodes_visited));
}
BENCHMARK(ray_through_tree<Octree<>>)->RangeMultiplier(10)->Range(1'000, 100'000);
BENCHMARK(ray_through_tree<LinearOctree<>>)->RangeMultiplier(10)->Range(1'000, 100'000);

}  // namespace
