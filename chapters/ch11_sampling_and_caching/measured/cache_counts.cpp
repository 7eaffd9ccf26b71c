#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/measured/density.hpp"
#include "chapters/ch11_sampling_and_caching/radiance_cache.hpp"
#include "common/camera.hpp"

#include <optional>

namespace space::ch11 {
namespace {

/// Indirect light in two rooms with a thin wall between, of which one is dark.
CacheLeakPoint cache_leak(std::string_view way, const RadianceCacheConfig& config,
                          const Options& options) {
    const LitScene lit = make_lit_scene("wall", options.seed);
    const LightTable lights(lit);
    const auto tree = FastBvh<>::build(lit.triangles);
    const int width = options.small ? 24 : 96;
    const PixelGrid pixels(lit.scene.camera, width, width * 3 / 4);
    const IrradianceCache cache = fill_cache(tree, lit, lights, pixels, config, options.threads);
    CacheLeakPoint point{.way = way, .records = cache.records().size()};
    double dark = 0.0, bright = 0.0;
    std::uint64_t bright_pixels = 0;
    for (const Ray& ray : camera_rays(pixels)) {
        const std::optional<Hit> hit = closest_hit(tree, ray);
        if (!hit) continue;
        const SurfacePoint at = surface_point(lit, ray, *hit);
        const auto irradiance = cache.irradiance(at.position, at.normal);
        const double light = irradiance ? luminance(*irradiance) : 0.0;
        constexpr double half_a_wall = 0.0078125;
        if (at.position.x > half_a_wall) {
            ++point.pixels;
            point.lit += light > 0.0;
            dark += light;
        } else if (at.position.x < -half_a_wall) {
            ++bright_pixels;
            bright += light;
        }
    }
    point.leak = (dark / double(point.pixels)) / (bright / double(bright_pixels));
    return point;
}

}  // namespace

std::vector<CacheLeakPoint> measure_cache_leaks(const Options& options) {
    const RadianceCacheConfig base{.accuracy = 0.5, .grid = {6, 18}, .seed = options.seed};
    const auto with = [&](bool gradients, bool neighbours) {
        RadianceCacheConfig config = base;
        config.gradients = gradients;
        config.neighbour_clamping = neighbours;
        return config;
    };
    return {cache_leak("constant", with(false, false), options),
            cache_leak("gradients, which limit radii", with(true, false), options),
            cache_leak("constant, clamped to neighbours", with(false, true), options),
            cache_leak("gradients, clamped to neighbours", with(true, true), options)};
}

std::vector<CacheCountPoint> measure_cache_counts(const Options& options) {
    const LitScene lit = make_lit_scene("interior", options.seed, options.small);
    const LightTable lights(lit);
    const auto tree = FastBvh<>::build(lit.triangles);
    const int width = options.small ? 16 : 80;
    const PixelGrid pixels(lit.scene.camera, width, width * 3 / 4);
    std::vector<CacheCountPoint> points;
    for (const double accuracy : {0.8, 0.4, 0.2}) {
        CacheCountPoint point{.accuracy = accuracy,
                              .pixels = static_cast<std::uint64_t>(width * (width * 3 / 4))};
        const auto records = [&](bool gradients) {
            const RadianceCacheConfig config{.accuracy = accuracy,
                                             .grid = {4, 12},
                                             .gradients = gradients,
                                             .seed = options.seed};
            return fill_cache(tree, lit, lights, pixels, config, options.threads).records().size();
        };
        point.constant = records(false);
        point.gradients = records(true);
        points.push_back(point);
    }
    return points;
}

}  // namespace space::ch11
