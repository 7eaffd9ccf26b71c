/// @file
/// Pictures by a radiance cache: light from lamps is sampled at each point that the eye sees; what
/// has met another surface before, or comes from the sky, is gathered at few points and
/// interpolated between them (Ward, Rubinstein and Clear 1988).
#pragma once

#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/hemisphere_gather.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance_cache.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance_record.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "chapters/ch11_sampling_and_caching/surface_point.hpp"
#include "chapters/ch11_sampling_and_caching/through_mirrors.hpp"
#include "common/accelerator.hpp"
#include "common/camera.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"
#include "common/parallel.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace space {

/// How a cache is filled.
struct RadianceCacheConfig {
    double accuracy = 0.3;  ///< the largest split-sphere error of a record that is used
    HemisphereGrid grid = {};
    /// Bounds of the records' radii, in parts of the diagonal of the scene's box.
    double smallest_radius = 0.03, largest_radius = 0.5;
    bool gradients = true;           ///< of first order between records; else each is constant
    bool neighbour_clamping = true;  ///< see IrradianceCache::clamp_to_neighbours
    /// Whether a gather's rays end where a record of an earlier round is valid. Else each goes on
    /// as a path does.
    bool reuse = true;
    int coarsest = 16;  ///< the first round's points are so many pixels apart: a power of two
    SamplePattern pattern = SamplePattern::sobol;  ///< of a record's rays
    std::uint64_t seed = 1;
};

// [arriving_light]
/// What comes along a ray, and from how far: one path. At each surface that is no mirror one point
/// of a light is asked; if the cache knows what else arrives there, the path ends with it, and goes
/// on with one cosine-weighted direction if not. Lights that were asked for before do not count
/// when a ray meets them: those of the ray itself count if it `sees_lights`, and those in mirrors.
/// With no cache (null), or an empty one, the mean is that of path_radiance.
template <Accelerator A>
SeenLight arriving_light(const A& accelerator, const LitScene& lit, const LightTable& table,
                         const IrradianceCache* cache, Ray ray, bool sees_lights,
                         Sampler& sampler) {
    SeenLight seen;
    Double3 throughput{1.0};
    for (int bounce = 0;; ++bounce) {
        const std::optional<Hit> hit = closest_hit(accelerator, ray);
        if (!hit) {
            seen.radiance += throughput * lit.sky();
            return seen;
        }
        const SurfacePoint surface = surface_point(lit, ray, *hit);
        if (bounce == 0) seen.distance = glm::length(surface.position - Double3(ray.origin));
        if (sees_lights) seen.radiance += throughput * lit.emitted(surface.triangle, surface.front);
        throughput *= lit.reflectance(surface.triangle);
        if (throughput == Double3(0.0)) return seen;

        sees_lights = lit.is_mirror(surface.triangle);
        if (sees_lights) {
            ray = mirror_ray(surface, ray);
        } else {
            Double3 irradiance =
                irradiance_from_lights(accelerator, table, surface, sampler, Lighting::solid_angle);
            std::optional<Double3> indirect;
            if (cache) indirect = cache->irradiance(surface.position, surface.normal);
            if (indirect) irradiance += *indirect;
            seen.radiance += throughput / std::numbers::pi * irradiance;
            if (indirect) return seen;
            ray =
                ray_from(surface, cosine_hemisphere(surface.normal, sampler.next_pair()).direction);
        }
        if (bounce >= 2 && !goes_on(throughput, sampler)) return seen;
    }
}
// [arriving_light]

/// The radiance that a ray from the eye sees, RGB, the light of lamps by one random sample. Where
/// the cache knows nothing, one random path stands for it.
template <Accelerator A>
Double3 cache_radiance(const A& accelerator, const LitScene& lit, const LightTable& table,
                       const IrradianceCache& cache, const Ray& ray, Sampler& sampler) {
    return arriving_light(accelerator, lit, table, &cache, ray, true, sampler).radiance;
}

/// Every `spacing`th pixel of every `spacing`th row.
struct PixelLattice {
    int spacing, x, y;  ///< the first pixel's column and row, below `spacing`

    std::vector<std::uint32_t> pixels(int width, int height) const {
        std::vector<std::uint32_t> found;
        for (int row = y; row < height; row += spacing)
            for (int column = x; column < width; column += spacing)
                found.push_back(static_cast<std::uint32_t>(row * width + column));
        return found;
    }
};
/// Lattices that hold each pixel once: a coarse one, then three for each halving of the spacing.
inline std::vector<PixelLattice> coarse_to_fine(int coarsest) {
    std::vector<PixelLattice> lattices{{coarsest, 0, 0}};
    for (int spacing = coarsest; spacing > 1; spacing /= 2) {
        const int half = spacing / 2;
        lattices.push_back({spacing, half, half});
        lattices.push_back({spacing, half, 0});
        lattices.push_back({spacing, 0, half});
    }
    return lattices;
}

/// Event: a round of filling has ended.
struct CacheRound {
    int spacing;          ///< pixels between the points that it asked
    std::size_t asked;    ///< points
    std::size_t records;  ///< of the cache after it: the new ones are the last
};

/// The bounds of radii in a scene.
inline RadiusLimits radius_limits(const LitScene& lit, const RadianceCacheConfig& config) {
    const double diagonal = diagonal_of(lit);
    return {config.smallest_radius * diagonal, config.largest_radius * diagonal};
}

/// The record of a point, by all rays of the grid. `stream` is its own number: what is random about
/// it hangs on that and the seed alone.
template <Accelerator A>
IrradianceRecord gather_record(const A& accelerator, const LitScene& lit, const LightTable& table,
                               const IrradianceCache* cache, const SurfacePoint& surface,
                               std::uint64_t stream, const RadiusLimits& limits,
                               const RadianceCacheConfig& config) {
    Sampler sampler(config.pattern, static_cast<std::uint32_t>(config.grid.cells()),
                    key_for(config.seed, 0));
    thread_local std::vector<SeenLight> memory;  // of one record after the other
    IrradianceRecord record =
        gather_irradiance(surface.position, surface.normal, config.grid, limits.smallest, sampler,
                          stream, memory, [&](const Double3& direction, Sampler& random) {
                              return arriving_light(accelerator, lit, table, cache,
                                                    ray_from(surface, direction), false, random);
                          });
    if (!config.gradients) record.translation_gradient = record.rotation_gradient = glm::dmat3(0.0);
    limit_radius(record, limits);
    const double least = config.accuracy * limits.smallest;  // what a record reaches in any case
    record.nearest = config.neighbour_clamping ? std::max(record.nearest, least) : double{infinity};
    return record;
}

// [fill]
/// A cache for the pixels of a picture: rounds ask points that are seen through lattices of pixels,
/// coarse to fine, and gather where no record of an earlier round is valid. All records of a round
/// are made in parallel and added in the order of the pixels, so that the cache is the same for any
/// number of threads. A CacheRound is told of each.
template <Accelerator A, class Observer = NoObserver>
IrradianceCache fill_cache(const A& accelerator, const LitScene& lit, const LightTable& table,
                           const PixelGrid& pixels, const RadianceCacheConfig& config,
                           unsigned threads, Observer&& observer = {}) {
    const RadiusLimits limits = radius_limits(lit, config);
    IrradianceCache cache(config.accuracy);
    for (const PixelLattice& lattice : coarse_to_fine(config.coarsest)) {
        const std::vector<std::uint32_t> asked = lattice.pixels(pixels.width, pixels.height);
        std::vector<std::optional<SurfacePoint>> points(asked.size());
        parallel_for(asked.size(), threads, 16, [&](std::size_t i) {
            const auto width = static_cast<std::uint32_t>(pixels.width);
            const Ray ray = pixels.ray(int(asked[i] % width), int(asked[i] / width));
            Sampler sampler(SamplePattern::independent, 1, key_for(config.seed, 1));
            sampler.start(asked[i], 0);
            const auto seen = seen_through_mirrors(accelerator, lit, ray, sampler).surface;
            const bool reflects =
                seen && lit.reflectance(seen->triangle) != Double3(0.0);  // lights do not
            if (reflects && !cache.covers(seen->position, seen->normal)) points[i] = seen;
        });
        std::vector<std::size_t> wanted;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (points[i]) wanted.push_back(i);
        std::vector<IrradianceRecord> made(wanted.size());
        parallel_for(wanted.size(), threads, 1, [&](std::size_t i) {
            made[i] = gather_record(accelerator, lit, table, config.reuse ? &cache : nullptr,
                                    *points[wanted[i]], asked[wanted[i]], limits, config);
        });
        cache.add(made);
        if (config.neighbour_clamping) cache.clamp_to_neighbours(threads);
        observer.observe(CacheRound{lattice.spacing, asked.size(), cache.records().size()});
    }
    return cache;
}
// [fill]

}  // namespace space
