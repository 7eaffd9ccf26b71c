/// @file
/// The light that arrives at a point of a surface directly, estimated from one sample: the ways to
/// choose where it may come from.
#pragma once

#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/multiple_importance.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "chapters/ch11_sampling_and_caching/surface_point.hpp"
#include "common/accelerator.hpp"

#include <cstdint>
#include <optional>

namespace space {

/// How light is looked for.
enum class Lighting {
    uniform,          ///< in all directions alike
    cosine,           ///< in directions, in proportion to their cosine
    area,             ///< at points of the lights, uniform in area
    solid_angle,      ///< at points of the lights, uniform in the chosen light's solid angle
    mis_area,         ///< cosine and area, each weighted by the power heuristic
    mis_solid_angle,  ///< cosine and solid_angle, the same
};

constexpr bool is_weighted(Lighting lighting) {
    return lighting == Lighting::mis_area || lighting == Lighting::mis_solid_angle;
}
constexpr bool samples_lights(Lighting lighting) {
    return lighting != Lighting::uniform && lighting != Lighting::cosine;
}

/// A direction as this way of lighting chooses it.
inline DirectionSample sample_direction(Lighting lighting, const Double3& n, const Double2& u) {
    return lighting == Lighting::uniform ? uniform_hemisphere(n, u) : cosine_hemisphere(n, u);
}
inline LightSample sample_light(Lighting lighting, const LightTable& table, const Double3& from,
                                double choice, const Double2& u) {
    return lighting == Lighting::area || lighting == Lighting::mis_area
               ? sample_light_area(table, from, choice, u)
               : sample_light_solid_angle(table, from, choice, u);
}

/// The density with which sample_light would have chosen the direction of a ray that met triangle
/// `hit.triangle`; 0 where it never does.
inline double light_pdf(Lighting lighting, const LightTable& table, const Ray& ray,
                        const Hit& hit) {
    const TriangleLight* light = table.find(hit.triangle);
    if (!light) return 0.0;
    const Double3 from{ray.origin};
    if (lighting == Lighting::solid_angle || lighting == Lighting::mis_solid_angle)
        return solid_angle_pdf(*light, SphericalTriangle(light->triangle, from));
    const Double3 to = hit_point(light->triangle, hit) - from;
    const double distance = glm::length(to);
    const double cosine = -glm::dot(light->normal, to) / distance;
    return cosine > 0.0 ? area_pdf(*light, cosine, distance) : 0.0;
}

/// How much the light counts that a ray met whose direction was chosen with density `pdf`, where
/// lights are looked for as well: not at all, or by the power heuristic.
inline double found_light_weight(Lighting lighting, const LightTable& table, const Ray& ray,
                                 const Hit& hit, double pdf) {
    if (!samples_lights(lighting)) return 1.0;
    return is_weighted(lighting) ? power_heuristic(pdf, light_pdf(lighting, table, ray, hit)) : 0.0;
}

// [irradiance_from_lights]
/// One point of one light: radiance times cosine over density, RGB in W / m^2 where radiance is in
/// W / (m^2 sr), if nothing stands between. Only for a Lighting that samples lights.
template <Accelerator A>
Double3 irradiance_from_lights(const A& accelerator, const LightTable& table,
                               const SurfacePoint& surface, Sampler& sampler, Lighting lighting) {
    const double choice = sampler.next();
    const Double2 u = sampler.next_pair();
    if (table.lights().empty()) return Double3(0.0);
    const LightSample sample = sample_light(lighting, table, Double3(surface.origin), choice, u);
    if (!sample.is_lit) return Double3(0.0);
    const double cosine = glm::dot(surface.normal, sample.direction);
    const Ray shadow =
        ray_to_light(surface.origin, sample.light->triangle, sample.point, sample.light->normal);
    const bool is_above = cosine > 0.0 && glm::dot(surface.normal, Double3(shadow.direction)) > 0.0;
    if (!is_above || any_hit(accelerator, shadow)) return Double3(0.0);
    const double weight =
        is_weighted(lighting)
            ? power_heuristic(sample.pdf, cosine_hemisphere_pdf(surface.normal, sample.direction))
            : 1.0;
    return weight * cosine / sample.pdf * sample.radiance;
}
// [irradiance_from_lights]

/// One direction: what the first surface on its way emits, or the sky.
template <Accelerator A>
Double3 irradiance_from_direction(const A& accelerator, const LitScene& lit,
                                  const LightTable& table, const SurfacePoint& surface,
                                  Sampler& sampler, Lighting lighting) {
    const DirectionSample sample = sample_direction(lighting, surface.normal, sampler.next_pair());
    const double factor = glm::dot(surface.normal, sample.direction) / sample.pdf;
    const Ray ray = ray_from(surface, sample.direction);
    const std::optional<Hit> hit = closest_hit(accelerator, ray);
    if (!hit) return factor * lit.sky();
    const bool front = seen_from_front(lit.triangles[hit->triangle], ray);
    return factor * found_light_weight(lighting, table, ray, *hit, sample.pdf) *
           lit.emitted(hit->triangle, front);
}

/// The irradiance by lights and sky that reaches the surface without a reflection: an unbiased
/// estimate from one sample of each kind that `lighting` uses. A ray is traced for the sky, too,
/// where there is one and the lights' samples cannot find it.
template <Accelerator A>
Double3 direct_irradiance(const A& accelerator, const LitScene& lit, const LightTable& table,
                          const SurfacePoint& surface, Sampler& sampler, Lighting lighting) {
    Double3 sum{0.0};
    if (samples_lights(lighting))
        sum += irradiance_from_lights(accelerator, table, surface, sampler, lighting);
    if (!samples_lights(lighting) || is_weighted(lighting) || lit.sky() != Double3(0.0))
        sum += irradiance_from_direction(accelerator, lit, table, surface, sampler, lighting);
    return sum;
}

}  // namespace space
