/// @file
/// What a ray comes to past all mirrors. Photon map and radiance cache know the light of diffuse
/// surfaces only: a mirror shows them another one.
#pragma once

#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"  // goes_on
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "chapters/ch11_sampling_and_caching/surface_point.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"

#include <optional>

namespace space {

/// The first diffuse surface on a ray's way, and what was met before it.
struct SeenSurface {
    std::optional<SurfacePoint> surface = {};  ///< none: the sky, or the way ended by roulette
    Double3 throughput{1.0};  ///< the part of the surface's light that reaches the ray's origin
    Double3 radiance{0.0};    ///< of lights seen on the way, of that surface, and of the sky
    int mirrors = 0;
};

/// Follows a ray from mirror to mirror; from the third on Russian roulette may end the way, without
/// bias.
template <Accelerator A>
SeenSurface seen_through_mirrors(const A& accelerator, const LitScene& lit, Ray ray,
                                 Sampler& sampler) {
    for (SeenSurface seen;; ++seen.mirrors) {
        const std::optional<Hit> hit = closest_hit(accelerator, ray);
        if (!hit) {
            seen.radiance += seen.throughput * lit.sky();
            return seen;
        }
        const SurfacePoint at = surface_point(lit, ray, *hit);
        seen.radiance += seen.throughput * lit.emitted(at.triangle, at.front);
        if (!lit.is_mirror(at.triangle)) {
            seen.surface = at;
            return seen;
        }
        seen.throughput *= lit.reflectance(at.triangle);
        if (seen.mirrors >= 2 && !goes_on(seen.throughput, sampler)) return seen;
        ray = mirror_ray(at, ray);
    }
}

}  // namespace space
