// Many threads ask one tree, and all get the naive loop's answers; no ray allocates memory.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "common/accelerator.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/box_rays.hpp"
#include "tests/ch10/every_kernel.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <atomic>
#include <cstddef>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace space {
namespace test {
extern std::atomic<std::ptrdiff_t> allocations_left;  // tests/ch05/allocations.cpp
}
namespace {

std::vector<Ray> some_rays(const std::vector<Triangle>& triangles, int count) {
    BoxRays maker(BinnedBuilder::build<3>(triangles), triangles, 3);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) rays.push_back(maker.next().ray);
    return rays;
}

}  // namespace

TEST_CASE("eight threads at one tree get the answers of the naive loop") {
    const auto triangles = scenes::soup(500, 0.1f, 24);
    const auto rays = some_rays(triangles, sized(4'000, 300));
    const auto naive = Naive<FilteredExact>::build(triangles);
    std::vector<std::optional<Hit>> expected;
    for (const Ray& ray : rays) expected.push_back(closest_hit(naive, ray));
    for_each_kernel(triangles, [&](const auto& bvh, const std::string&) {
        std::atomic<std::size_t> wrong = 0;
        std::vector<std::jthread> threads;
        for (std::size_t first = 0; first < 8; ++first)
            threads.emplace_back([&, first] {
                for (std::size_t k = 0; k < rays.size(); ++k) {  // each in another order
                    const std::size_t i = (k + first * rays.size() / 8) % rays.size();
                    wrong += closest_hit(bvh, rays[i]) != expected[i];
                    wrong += any_hit(bvh, rays[i]) != expected[i].has_value();
                }
            });
        threads.clear();
        REQUIRE(wrong == 0);
    });
}

TEST_CASE("no ray allocates memory") {
    const auto triangles = scenes::soup(500, 0.1f, 24);
    const auto rays = some_rays(triangles, 2'000);
    for_each_kernel(triangles, [&](const auto& bvh, const std::string&) {
        std::size_t hits = 0;
        test::allocations_left = 0;  // the next one throws
        for (const Ray& ray : rays) hits += closest_hit(bvh, ray).has_value();
        for (const Ray& ray : rays) hits += any_hit(bvh, ray);
        test::allocations_left = -1;
        REQUIRE(hits > 500);
    });
}

}  // namespace space
