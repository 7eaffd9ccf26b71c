/// @file
/// Exercise 1.4, solution.
#pragma once

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/shading.hpp"

#include <cstdint>
#include <vector>

namespace space {

inline std::vector<std::uint64_t> tests_per_pixel(const Scene& scene, int width, int height) {
    const Naive<> naive = Naive<>::build(scene.mesh.triangles());
    const CameraFrame frame(scene.camera);
    std::vector<std::uint64_t> tests;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Ray ray = camera_ray(scene.camera, frame, x + 0.5, y + 0.5, width, height);
            TraversalCounts counts;
            if (const auto hit = naive.closest_hit(ray, counts))
                shade(scene, ray, *hit,
                      [&](const Ray& shadow) { return !naive.any_hit(shadow, counts); });
            tests.push_back(counts.triangles_tested);
        }
    return tests;
}

}  // namespace space
