#include "chapters/ch07_bounding_volume_hierarchies/measured/ray_task.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "common/camera.hpp"
#include "common/parallel.hpp"
#include "common/random.hpp"

#include <algorithm>
#include <utility>

namespace space::ch07 {
namespace {

/// The first so many answers beside the naive loop's.
void check(RayTask& task, const std::vector<Ray>& rays, const Answers& answers, std::size_t most,
           unsigned threads) {
    const auto naive = Naive<FilteredExact>::build(task.triangles);
    std::vector<std::uint8_t> differs(std::min(rays.size(), most));
    parallel_for(differs.size(), threads, 16,
                 [&](std::size_t i) { differs[i] = closest_hit(naive, rays[i]) != answers[i]; });
    task.checked += differs.size();
    task.wrong += static_cast<std::uint64_t>(std::ranges::count(differs, 1));
}

}  // namespace

RayTask::RayTask(std::string name, const Scene& made, int width, int height,
                 std::uint64_t naive_tests, unsigned threads, std::uint64_t seed)
    : scene(std::move(name)), triangles(made.mesh.triangles()) {
    const auto tree = Bvh<BinnedBuilder>::build(triangles);
    auto& [from_eye, shadow, diffuse] = rays;
    from_eye = camera_rays(PixelGrid(made.camera, width, height));
    Pcg32 random(seed);
    for (const Ray& ray : from_eye) {
        const std::optional<Hit> hit = closest_hit(tree, ray);
        camera_hits.push_back(hit);
        if (!hit) continue;
        const Triangle& triangle = triangles[hit->triangle];
        const Double3 n = normal_towards(triangle, ray);
        const Point3 origin = shadow_origin(triangle, hit_point(triangle, *hit), n);
        // Points of a sphere that touches the plane are distributed as the cosine.
        diffuse.push_back({.origin = origin, .direction = Vector3(n + random_direction(random))});
        if (made.lights.empty()) continue;
        const Ray to_lamp = shadow_ray(origin, made.lights[diffuse.size() % made.lights.size()]);
        if (glm::dot(n, Double3(to_lamp.direction)) > 0.0) shadow.push_back(to_lamp);
    }
    for (const Ray& ray : diffuse) diffuse_hits.push_back(closest_hit(tree, ray));
    const std::size_t most = naive_tests / (2 * std::max<std::size_t>(triangles.size(), 1));
    check(*this, from_eye, camera_hits, most, threads);
    check(*this, diffuse, diffuse_hits, most, threads);
}

}  // namespace space::ch07
