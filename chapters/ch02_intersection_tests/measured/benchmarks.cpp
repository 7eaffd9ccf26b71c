/// Micro-benchmarks of chapter 2: every test of its lists, on rays of which about one in eight
/// hits; and the square roots. Run   ch02_benchmarks --benchmark_filter=triangle
/// --benchmark_enable_random_interleaving=true --benchmark_repetitions=9
#include "chapters/ch02_intersection_tests/shape_tests.hpp"
#include "chapters/ch02_intersection_tests/square_roots.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/random.hpp"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace {

using namespace space;

constexpr std::size_t shapes = 512, rays_in_all = 64;

std::vector<Ray> random_rays() {
    Pcg32 random(1);
    std::vector<Ray> rays;
    while (rays.size() < rays_in_all) {
        const Point3 origin = 3.0f * random_vector(random);
        rays.push_back({.origin = origin, .direction = random_vector(random) - origin});
    }
    return rays;
}
template <class Shape>
Shape random_shape(Pcg32& random) {
    const Point3 p = random_vector(random), q = random_vector(random);
    if constexpr (std::is_same_v<Shape, Triangle>) return {p, q, random_vector(random)};
    if constexpr (std::is_same_v<Shape, Aabb>) return {glm::min(p, q), glm::max(p, q)};
    if constexpr (std::is_same_v<Shape, Sphere>) return {p, random.uniform(0.2f, 0.8f)};
}

/// All shapes against all rays; what the test prepares of a ray is part of the time, what it
/// prepares of a shape is not.
template <class Test, class Shape>
void shapes_against_rays(benchmark::State& state) {
    const std::vector<Ray> rays = random_rays();
    Pcg32 random(2);
    std::vector<decltype(prepared<Test>(Shape{}))> ready;
    while (ready.size() < shapes) ready.push_back(prepared<Test>(random_shape<Shape>(random)));
    for (auto _ : state)
        for (const Ray& ray : rays) {
            const auto prepared_ray = prepared<Test>(ray);
            for (const auto& shape : ready) {
                if constexpr (requires { Test::hits(prepared_ray, shape); })
                    benchmark::DoNotOptimize(Test::hits(prepared_ray, shape));
                else
                    benchmark::DoNotOptimize(Test::intersect(prepared_ray, shape).has_value());
            }
        }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(shapes * rays_in_all));
}

template <class Root>
void roots(benchmark::State& state, const Root& root) {
    Pcg32 random(3);
    std::vector<float> numbers(4096);
    for (float& a : numbers) a = random.uniform(1.0f, 4.0f);
    for (auto _ : state)
        for (const float a : numbers) benchmark::DoNotOptimize(root(a));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(numbers.size()));
}

template <int Rounds>
void register_roots() {
    benchmark::RegisterBenchmark(("root/Newton " + std::to_string(Rounds)).c_str(),
                                 [](benchmark::State& state) {
                                     roots(state, [](float a) { return newton_root<Rounds>(a); });
                                 });
    benchmark::RegisterBenchmark(
        ("root/reciprocal " + std::to_string(Rounds)).c_str(), [](benchmark::State& state) {
            roots(state, [](float a) { return a * reciprocal_newton_root<Rounds>(a); });
        });
}

const bool registered = [] {
    for_each_named(triangle_tests, [](std::size_t, const auto& named) {
        benchmark::RegisterBenchmark(("triangle/" + std::string(named.name)).c_str(),
                                     shapes_against_rays<TestOf<decltype(named)>, Triangle>);
    });
    for_each_named(box_tests, [](std::size_t, const auto& named) {
        benchmark::RegisterBenchmark(("box/" + std::string(named.name)).c_str(),
                                     shapes_against_rays<TestOf<decltype(named)>, Aabb>);
    });
    for_each_named(sphere_tests, [](std::size_t, const auto& named) {
        benchmark::RegisterBenchmark(("sphere/" + std::string(named.name)).c_str(),
                                     shapes_against_rays<TestOf<decltype(named)>, Sphere>);
    });
    register_roots<2>();
    register_roots<3>();
    register_roots<4>();
    benchmark::RegisterBenchmark("root/std::sqrt", [](benchmark::State& state) {
        roots(state, [](float a) { return std::sqrt(a); });
    });
    return true;
}();

}  // namespace
