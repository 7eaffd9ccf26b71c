/// @file
/// Exercise 1.4: Tests per pixel
/// Difficulty 2 of 3, about 25 minutes.
///
/// What does a pixel cost? Return, row by row from the top left, the number of ray-triangle tests
/// that the naive tracer makes for each pixel of a picture with one ray through each pixel's
/// centre: those of the camera's ray, and those of the shadow rays from what it hits. The stub
/// counts the camera's ray alone.
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
            const auto hit = naive.closest_hit(ray, counts);
            static_cast<void>(hit);
            tests.push_back(counts.triangles_tested);  // TODO: and the shadow rays' tests
        }
    return tests;
}

}  // namespace space
