/// @file
/// The first pass of photon mapping (Jensen 2001, "Realistic Image Synthesis Using Photon Mapping",
/// chapter 5): light leaves the lamps in photons of nearly equal power, and is stored wherever one
/// meets a diffuse surface.
#pragma once

#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/photon.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "chapters/ch11_sampling_and_caching/surface_point.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/parallel.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

namespace space {

/// What became of photons: emitted = absorbed + left + stopped.
struct PhotonCounts {
    std::uint64_t emitted = 0;
    std::uint64_t absorbed = 0;  ///< by a surface
    std::uint64_t left = 0;      ///< the scene
    std::uint64_t stopped = 0;   ///< after PhotonConfig::most_bounces; aimed ones also on their way
                                 ///< to the mirror, and at the first diffuse surface

    PhotonCounts& operator+=(const PhotonCounts& other) {
        emitted += other.emitted;
        absorbed += other.absorbed;
        left += other.left;
        stopped += other.stopped;
        return *this;
    }
    bool operator==(const PhotonCounts&) const = default;
};

/// Photons in the order of their emission, those of one path one after the other.
struct PhotonTrace {
    std::vector<Photon> photons = {};
    PhotonCounts counts = {};
};

/// How many photons, and by which numbers.
struct PhotonConfig {
    std::uint32_t count = 100'000;  ///< emitted
    std::uint64_t seed = 1;
    /// DensityEstimator is proved for photons that are independent.
    SamplePattern pattern = SamplePattern::independent;
    int most_bounces = 1'000;  ///< a photon's end between white walls: 0.99^1000 is 4e-5
    unsigned threads = 1;      ///< the same photons for any number
};

// [russian_roulette]
/// Russian roulette (Arvo & Kirk 1990) at a surface that reflects the part `reflectance`: nothing,
/// where the photon is absorbed; else its power on the way on. It goes on with the probability that
/// leaves its largest component as it was: there will be fewer photons, not weaker ones, and the
/// mean of what goes on is reflectance * power in each colour.
inline std::optional<Double3> reflected_power(const Double3& power, const Double3& reflectance,
                                              double u) {
    const auto largest = [](const Double3& v) { return std::max({v.x, v.y, v.z}); };
    const Double3 reflected = reflectance * power;
    const double chance = largest(reflected) / largest(power);
    if (!(u < chance)) return std::nullopt;
    return reflected / chance;
}
// [russian_roulette]

// [trace_photon]
/// Follows a photon until it is absorbed or leaves, and stores it at each diffuse surface on its
/// way, with the power that it arrives with. One that is aimed at a mirror must meet that triangle
/// first, and ends at the first diffuse surface.
template <Accelerator A>
void trace_photon(const A& accelerator, const LitScene& lit, Ray ray, Double3 power,
                  Sampler& sampler, const PhotonConfig& config, PhotonTrace& trace,
                  std::optional<std::uint32_t> aim = {}) {
    PhotonPath path = PhotonPath::direct;
    for (int bounce = 0; bounce < config.most_bounces; ++bounce) {
        const std::optional<Hit> hit = closest_hit(accelerator, ray);
        if (!hit) return void(++trace.counts.left);
        if (aim && bounce == 0 && hit->triangle != *aim) break;
        const SurfacePoint at = surface_point(lit, ray, *hit);
        const bool is_mirror = lit.is_mirror(at.triangle);
        if (!is_mirror)
            trace.photons.push_back({Point3(at.position), Vector3(at.normal), power, path});
        if (!is_mirror && aim) break;
        const auto reflected = reflected_power(power, lit.reflectance(at.triangle), sampler.next());
        if (!reflected) return void(++trace.counts.absorbed);
        power = *reflected;
        if (is_mirror) {
            if (path == PhotonPath::direct) path = PhotonPath::caustic;
            ray = mirror_ray(at, ray);
        } else {
            path = PhotonPath::indirect;
            ray = ray_from(at, cosine_hemisphere(at.normal, sampler.next_pair()).direction);
        }
    }
    ++trace.counts.stopped;
}
// [trace_photon]

/// Photons draw from streams of random numbers that no pixel has.
inline constexpr std::uint64_t photon_stream = ~std::uint64_t{0}, aimed_stream = photon_stream - 1;

/// Calls trace_one(sampler, trace) for each photon, whose random numbers are its own. Chunks of
/// photons on several threads, joined in their order.
template <class TraceOne>
PhotonTrace trace_each(const PhotonConfig& config, std::uint64_t stream,
                       const TraceOne& trace_one) {
    constexpr std::uint32_t chunk = 1024;
    std::vector<PhotonTrace> parts((config.count + std::size_t{chunk} - 1) / chunk);
    parallel_for(parts.size(), config.threads, 1, [&](std::size_t part) {
        const auto first = static_cast<std::uint32_t>(part * chunk);
        Sampler sampler(config.pattern, config.count, config.seed);
        for (std::uint32_t i = first; i < config.count && i - first < chunk; ++i) {
            sampler.start(stream, i);
            ++parts[part].counts.emitted;
            trace_one(sampler, parts[part]);
        }
    });
    PhotonTrace all;
    for (const PhotonTrace& part : parts) {
        all.photons.insert(all.photons.end(), part.photons.begin(), part.photons.end());
        all.counts += part.counts;
    }
    return all;
}

/// A photon's way from a point of a light, in a direction of length 1.
inline Ray photon_ray(const TriangleLight& light, const Double3& from, const Double3& to) {
    return {.origin = shadow_origin(light.triangle, from, light.normal), .direction = Vector3(to)};
}

// [emission]
/// Photons from all lights: from points uniform on them, in directions by Lambert's law, so that
/// all photons of a light begin with the same power, pi L A over its probability and their number.
/// The sky emits none.
template <Accelerator A>
PhotonTrace trace_photons(const A& accelerator, const LitScene& lit, const LightTable& lights,
                          const PhotonConfig& config) {
    if (lights.lights().empty()) return {};
    return trace_each(config, photon_stream, [&](Sampler& sampler, PhotonTrace& trace) {
        const TriangleLight& light = lights.choose(sampler.next());
        const Double3 from = uniform_point(light.triangle, sampler.next_pair());
        const Double3 to = cosine_hemisphere(light.normal, sampler.next_pair()).direction;
        const double weight = std::numbers::pi * light.area / (light.probability * config.count);
        trace_photon(accelerator, lit, photon_ray(light, from, to), weight * light.radiance,
                     sampler, config, trace);
    });
}
// [emission]

}  // namespace space
