/// @file
/// Exercise 1.4, a near miss: every light costs a test of every triangle, as if each light had a
/// shadow ray and no shadow ray stopped at the first hit.
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
            if (naive.closest_hit(ray, counts))
                counts.triangles_tested += scene.lights.size() * scene.mesh.faces.size();
            tests.push_back(counts.triangles_tested);
        }
    return tests;
}

}  // namespace space
