/// Micro-benchmarks of chapter 4: builds by each rule, a triangle clipped to a cell, a ray through
/// a whole tree, the nearest points. Run ch04_benchmarks --benchmark_filter=build
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/point_search.hpp"
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
void build(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(state.range(1));
    const KdTreeConfig config{.rule = KdTreeConfig::Rule(state.range(0))};
    for (auto _ : state) benchmark::DoNotOptimize(KdBuilder<3>::build(triangles, config));
    state.SetItemsProcessed(state.iterations() * state.range(1));
    state.SetLabel(std::array{"middle", "median", "SAH"}[std::size_t(state.range(0))]);
}
BENCHMARK(build)->ArgsProduct({{0, 1, 2}, {1'000, 10'000, 100'000}});

/// A half of the triangle's box is the cell.
void clip_triangle(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(1'024);
    std::size_t i = 0;
    for (auto _ : state) {
        const Triangle& triangle = triangles[i++ % triangles.size()];
        Aabb cell = bounds(triangle);
        cell.max[cell.longest_axis()] = cell.centroid()[cell.longest_axis()];
        benchmark::DoNotOptimize(clipped_bounds<3>(triangle, cell));
    }
}
BENCHMARK(clip_triangle);

/// Items are nodes visited.
void ray_through_tree(benchmark::State& state) {
    const std::vector<Triangle> triangles = soup(state.range(0));
    const auto tree = KdTree<>::build(triangles);
    const std::vector<Ray> rays = rays_within(triangles, 1'024, 1);
    TraversalCounts counts;
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(tree.closest_hit(rays[i++ % 1'024], counts));
    state.SetItemsProcessed(static_cast<std::int64_t>(counts.nodes_visited));
}
BENCHMARK(ray_through_tree)->RangeMultiplier(10)->Range(1'000, 100'000);

void nearest_points(benchmark::State& state) {
    Pcg32 random(1);
    std::vector<Point3> points;
    for (int i = 0; i < 100'000; ++i) points.push_back(random_point(random, 0.0f, 1.0f));
    const auto tree = KdPoints<3>::build(points);
    NearestSearch<3> search(tree, static_cast<std::size_t>(state.range(0)));
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(search(points[i++ % points.size()]).data());
}
BENCHMARK(nearest_points)->Arg(1)->Arg(8)->Arg(64);

}  // namespace
