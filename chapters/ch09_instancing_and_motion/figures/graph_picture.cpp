#include "chapters/ch09_instancing_and_motion/figures/graph_picture.hpp"

#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "common/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace space::ch09 {
namespace {

Color seen_along(const GraphPicture& picture, const Ray& ray) {
    NoCounts none;
    const std::optional<PlacedHit> hit = closest_placed_hit(picture.trees, ray, none);
    if (!hit) return picture.haze;
    const Located at = picture.graph.locate(hit->triangle);
    const Triangle triangle =
        flattened(at.to_world, picture.graph.object(at.mesh).triangles[at.triangle]);
    const Double3 n = normal_towards(triangle, ray);
    const Double3 point = hit_point(triangle, {.t = hit->t, .u = hit->u, .v = hit->v});
    // All that the sky above sends, and the ground below.
    const auto above = static_cast<float>(0.5 + 0.5 * glm::dot(n, picture.up));
    Color light = glm::mix(picture.ground, picture.sky, above);
    const Double3 to_sun = glm::normalize(picture.to_sun);
    const double cosine = glm::dot(n, to_sun);
    if (cosine > 0.0) {
        const Ray shadow{.origin = shadow_origin(triangle, point, n), .direction = Vector3(to_sun)};
        if (!any_placed_hit(picture.trees, shadow, none))
            light += picture.sun * static_cast<float>(cosine);
    }
    const auto clear =
        static_cast<float>(std::exp(-glm::length(point - Double3(ray.origin)) / picture.clear));
    return glm::mix(picture.haze, light * picture.color(at, hit->triangle), clear);
}

}  // namespace

Image render(const GraphPicture& picture, int width, int height, unsigned threads) {
    Image image(width, height);
    const PixelGrid grid(picture.camera, width, height);
    const int n = picture.samples;
    parallel_for(static_cast<std::size_t>(height), threads, 1, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width; ++x) {
            Color sum{0.0f};
            for (int i = 0; i < n * n; ++i)
                sum += glm::min(Color(1.0f),
                                seen_along(picture, grid.ray_through(x + (i % n + 0.5) / n,
                                                                     y + (i / n + 0.5) / n)));
            image.at(x, y) = sum / static_cast<float>(n * n);
        }
    });
    return image;
}

}  // namespace space::ch09
