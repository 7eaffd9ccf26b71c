#include "chapters/ch10_fast_traversal/measured/traced_scene.hpp"

#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch10_fast_traversal/packets.hpp"
#include "common/camera.hpp"
#include "common/parallel.hpp"
#include "common/program/error.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"

#include <glm/geometric.hpp>

#include <utility>

namespace space::ch10 {
namespace {

/// What is not there on this machine is left out.
std::optional<Scene> scene_that_is_there(const std::string& name, const Options& options) {
    try {
        return make_scene(name, options.seed);
    } catch (const Error&) {
        return {};
    }
}

/// The binary tree's answers.
Answers answers_of(const Bvh<BinnedBuilder>& tree, const std::vector<Ray>& rays, ManyQuery query,
                   unsigned threads) {
    Answers answers(rays.size());
    parallel_for(rays.size(), threads, 256,
                 [&](std::size_t i) { answers[i] = single_answer(tree, rays[i], query); });
    return answers;
}

/// Those that begin where camera rays have hit.
void add_secondary_rays(TracedScene& traced, const Scene& scene, std::uint64_t seed) {
    auto& [from_eye, shadow, diffuse] = traced.rays;
    Pcg32 random(seed);
    for (std::size_t i = 0; i < from_eye.size(); ++i) {
        const std::optional<Hit>& hit = traced.answers[camera_kind][i];
        if (!hit) continue;
        const Triangle& triangle = traced.triangles[hit->triangle];
        const Double3 n = normal_towards(triangle, from_eye[i]);
        const Point3 origin = shadow_origin(triangle, hit_point(triangle, *hit), n);
        // Points of a sphere that touches the plane are distributed as the cosine.
        diffuse.push_back({.origin = origin, .direction = Vector3(n + random_direction(random))});
        if (scene.lights.empty()) continue;
        const Ray to_lamp = shadow_ray(origin, scene.lights[i % scene.lights.size()]);
        if (glm::dot(n, Double3(to_lamp.direction)) > 0.0) shadow.push_back(to_lamp);
    }
}

}  // namespace

std::optional<TracedScene> traced_scene(const std::string& name, bool is_long, int width,
                                        int height, const Options& options) {
    const std::optional<Scene> scene = scene_that_is_there(name, options);
    if (!scene) return {};
    TracedScene traced{.name = name,
                       .is_long = is_long,
                       .triangles = scene->mesh.triangles(),
                       .rays = {},
                       .answers = {}};
    const auto tree = Bvh<BinnedBuilder>::build(traced.triangles);
    const std::vector<Ray> by_rows = camera_rays(PixelGrid(scene->camera, width, height));
    for (const std::uint32_t pixel : tiled_order(width, height, 8))
        traced.rays[camera_kind].push_back(by_rows[pixel]);
    const auto answer = [&](RayKind kind, ManyQuery query) {
        traced.answers[kind] = answers_of(tree, traced.rays[kind], query, options.threads);
    };
    answer(camera_kind, ManyQuery::closest);
    add_secondary_rays(traced, *scene, options.seed);
    answer(shadow_kind, ManyQuery::any);
    answer(diffuse_kind, ManyQuery::closest);
    return traced;
}

}  // namespace space::ch10
