/// @file
/// The second pass of photon mapping (Jensen 2001, "Realistic Image Synthesis Using Photon
/// Mapping", chapter 8): direct light by samples, what mirrors threw and what surfaces reflected
/// from photon maps.
#pragma once

#include "chapters/ch11_sampling_and_caching/aimed_photons.hpp"
#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/photon_map.hpp"
#include "chapters/ch11_sampling_and_caching/photon_tracing.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "chapters/ch11_sampling_and_caching/surface_point.hpp"
#include "chapters/ch11_sampling_and_caching/through_mirrors.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"

#include <cstdint>
#include <numbers>

namespace space {

/// Two maps: a caustic is small and bright and wants many photons, other light changes slowly.
struct PhotonMaps {
    PhotonMap caustic = {}, indirect = {};

    /// `photons.count` from the lights, and `caustic_count` aimed at mirrors where there are any;
    /// 0: none is aimed, and those that meet a mirror by chance make the caustics.
    template <Accelerator A>
    static PhotonMaps build(const A& accelerator, const LitScene& lit, const LightTable& lights,
                            const PhotonConfig& photons, std::uint32_t caustic_count) {
        const PhotonTrace all = trace_photons(accelerator, lit, lights, photons);
        PhotonMaps maps{.indirect = PhotonMap::build(all.photons, PhotonPath::indirect)};
        if (caustic_count == 0) {
            maps.caustic = PhotonMap::build(all.photons, PhotonPath::caustic);
        } else {
            PhotonConfig aimed = photons;
            aimed.count = caustic_count;
            maps.caustic =
                PhotonMap::build(trace_aimed_photons(accelerator, lit, lights, aimed).photons);
        }
        return maps;
    }
};

/// How the maps are asked.
struct PhotonLookupConfig {
    DensityConfig caustic = {}, indirect = {};
    Lighting lighting = Lighting::solid_angle;  ///< of direct light: one that samples lights
    int gather_rays = 0;  ///< a final gather of so many rays; 0: the map itself is seen
};

/// Estimates of both maps. It holds the memory that these take, so one of these serves one thread.
class PhotonLookup {
  public:
    /// The maps must outlive this. @throws std::invalid_argument as DensityEstimator
    explicit PhotonLookup(const PhotonMaps& maps, const PhotonLookupConfig& config = {})
        : config_(config),
          caustic_(maps.caustic, config.caustic),
          indirect_(maps.indirect, config.indirect) {}

    const PhotonLookupConfig& config() const { return config_; }
    Double3 caustic(const SurfacePoint& at) { return caustic_.irradiance(at.position, at.normal); }
    Double3 indirect(const SurfacePoint& at) {
        return indirect_.irradiance(at.position, at.normal);
    }

  private:
    PhotonLookupConfig config_;
    DensityEstimator caustic_, indirect_;
};

// [final_gather]
/// The irradiance by light that other diffuse surfaces reflect, from rays to those surfaces: what
/// is blurred there is averaged here, and no edge gets darker. Each ray sees what lights, the
/// caustics and the other photons give to the surface that it meets.
template <Accelerator A>
Double3 gathered_irradiance(const A& accelerator, const LitScene& lit, const LightTable& lights,
                            PhotonLookup& lookup, const SurfacePoint& at, Sampler& sampler) {
    Double3 sum{0.0};
    for (int i = 0; i < lookup.config().gather_rays; ++i) {
        const Double3 direction = cosine_hemisphere(at.normal, sampler.next_pair()).direction;
        const SeenSurface seen =
            seen_through_mirrors(accelerator, lit, ray_from(at, direction), sampler);
        if (!seen.surface) continue;
        const Double3 direct = direct_irradiance(accelerator, lit, lights, *seen.surface, sampler,
                                                 lookup.config().lighting);
        // Times rho / pi for the radiance, times pi for cosine over density.
        sum += seen.throughput * lit.reflectance(seen.surface->triangle) *
               (direct + lookup.caustic(*seen.surface) + lookup.indirect(*seen.surface));
    }
    return sum / static_cast<double>(lookup.config().gather_rays);
}
// [final_gather]

// [photon_radiance]
/// The radiance that arrives along the ray, RGB. Each path of light is counted once: lights that
/// are seen, straight or in mirrors; at the first diffuse surface what comes from lights (by a
/// sample), from lights by mirrors (caustics), and from other diffuse surfaces. Of the sky only
/// what reaches that surface or the eye without another diffuse surface is seen.
template <Accelerator A>
Double3 photon_radiance(const A& accelerator, const LitScene& lit, const LightTable& lights,
                        PhotonLookup& lookup, const Ray& ray, Sampler& sampler) {
    const SeenSurface seen = seen_through_mirrors(accelerator, lit, ray, sampler);
    if (!seen.surface) return seen.radiance;
    const SurfacePoint& at = *seen.surface;
    const Double3 direct =
        direct_irradiance(accelerator, lit, lights, at, sampler, lookup.config().lighting);
    const Double3 indirect =
        lookup.config().gather_rays > 0
            ? gathered_irradiance(accelerator, lit, lights, lookup, at, sampler)
            : lookup.indirect(at);
    return seen.radiance + seen.throughput * lit.reflectance(at.triangle) / std::numbers::pi *
                               (direct + lookup.caustic(at) + indirect);
}
// [photon_radiance]

}  // namespace space
