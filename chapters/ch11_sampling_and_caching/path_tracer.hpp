/// @file
/// A path tracer (Kajiya 1986): the light that arrives along a ray, estimated without bias by one
/// path of rays from surface to surface.
#pragma once

#include "chapters/ch11_sampling_and_caching/irradiance.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "chapters/ch11_sampling_and_caching/surface_point.hpp"
#include "common/accelerator.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

namespace space {

/// What the caller chooses about paths. Only most_bounces changes their mean.
struct PathConfig {
    Lighting lighting = Lighting::mis_solid_angle;
    int roulette_from = 3;  ///< the reflection from which on a path may end by chance
    int most_bounces = std::numeric_limits<int>::max();  ///< reflections; 1: direct light only
    bool sees_lights = true;  ///< false: without what the ray's first hit emits itself
};

/// Russian roulette: the probability with which a path goes on that still carries this part of the
/// light it finds. What goes on is divided by it, so the mean stays. Below 1, so that a path
/// between white walls ends, too.
inline double survival(const Double3& throughput) {
    return std::min(0.95, std::max({throughput.x, throughput.y, throughput.z}));
}
/// Whether the path goes on; its throughput is that of what goes on.
inline bool goes_on(Double3& throughput, Sampler& sampler) {
    const double chance = survival(throughput);
    if (sampler.next() >= chance) return false;
    throughput /= chance;
    return true;
}

/// The ray on which a path goes on, and how it was chosen.
struct Reflection {
    Ray ray;
    std::optional<double> pdf;  ///< none where a mirror had no choice
    Double3 factor;             ///< of the light that comes along the ray, what leaves
};

/// At a mirror there is one direction, and no density. A Lambert surface of reflectance rho sends
/// rho / pi of the irradiance to every side: rho / pi cosine over density of what one ray finds.
inline Reflection reflected(const LitScene& lit, const SurfacePoint& surface, const Ray& ray,
                            Sampler& sampler, Lighting lighting) {
    const Double3 reflectance = lit.reflectance(surface.triangle);
    if (lit.is_mirror(surface.triangle)) return {mirror_ray(surface, ray), {}, reflectance};
    const DirectionSample sample = sample_direction(lighting, surface.normal, sampler.next_pair());
    const double cosine = glm::dot(surface.normal, sample.direction);
    return {ray_from(surface, sample.direction), sample.pdf,
            cosine / (std::numbers::pi * sample.pdf) * reflectance};
}

// [path]
/// The radiance that arrives along the ray, RGB. Unbiased; the variance depends on the Lighting.
/// Each surface's light is counted once: what a light's sample at the surface before can find too,
/// counts there, or both are weighted; what only a ray can find (seen at once or in a mirror, the
/// sky) counts in full.
template <Accelerator A>
Double3 path_radiance(const A& accelerator, const LitScene& lit, const LightTable& table, Ray ray,
                      Sampler& sampler, const PathConfig& config = {}) {
    const Lighting lighting = config.lighting;
    Double3 radiance{0.0}, throughput{1.0};
    std::optional<double> pdf;
    for (int bounce = 0;; ++bounce) {
        const std::optional<Hit> hit = closest_hit(accelerator, ray);
        if (!hit) return radiance + throughput * lit.sky();
        const SurfacePoint surface = surface_point(lit, ray, *hit);
        const Double3 emitted = lit.emitted(surface.triangle, surface.front);
        if (emitted != Double3(0.0) && (bounce > 0 || config.sees_lights)) {
            const double weight = pdf ? found_light_weight(lighting, table, ray, *hit, *pdf) : 1.0;
            radiance += weight * throughput * emitted;
        }
        const Double3 reflectance = lit.reflectance(surface.triangle);
        if (bounce == config.most_bounces || reflectance == Double3(0.0)) return radiance;

        if (samples_lights(lighting) && !lit.is_mirror(surface.triangle))
            radiance += throughput * reflectance / std::numbers::pi *
                        irradiance_from_lights(accelerator, table, surface, sampler, lighting);
        const Reflection next = reflected(lit, surface, ray, sampler, lighting);
        ray = next.ray;
        pdf = next.pdf;
        throughput *= next.factor;

        if (bounce + 1 >= config.roulette_from && !goes_on(throughput, sampler)) return radiance;
    }
}
// [path]

}  // namespace space
