/// @file
/// Photons that are sent towards mirrors only: of those that leave a light in all directions few
/// make a caustic. Jensen's projection map (2001, section 5.1.2) keeps a grid of the directions in
/// which a mirror may lie; here the mirrors' own points are chosen, as a light's are for shadow
/// rays.
#pragma once

#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/photon_tracing.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace space {

/// The mirrors of a scene, by area.
struct MirrorTable {
    std::vector<std::uint32_t> triangles = {};
    std::vector<double> area_up_to = {};  ///< of a triangle and all before it

    static MirrorTable of(const LitScene& lit) {
        MirrorTable table;
        double sum = 0.0;
        for (std::uint32_t i = 0; i < lit.triangles.size(); ++i) {
            const double area = 0.5 * glm::length(normal(lit.triangles[i]));
            if (!lit.is_mirror(i) || !(area > 0.0)) continue;
            table.triangles.push_back(i);
            table.area_up_to.push_back(sum += area);
        }
        return table;
    }
    double area() const { return area_up_to.empty() ? 0.0 : area_up_to.back(); }
    /// The triangle that u, uniform in [0, 1), chooses in proportion to its area.
    std::uint32_t choose(double u) const {
        const auto at = std::ranges::upper_bound(area_up_to, u * area());
        const auto last = static_cast<std::ptrdiff_t>(triangles.size()) - 1;
        return triangles[static_cast<std::size_t>(std::min(at - area_up_to.begin(), last))];
    }
};

// [aim]
/// Caustics alone: a point of a light and one of a mirror, each uniform in area. Of the light's
/// radiance L the photon carries L cos cos' / d^2 over both densities, if the mirror's point is the
/// first thing on its way. Powers differ with the distance d and the two angles, but their sum is
/// right in the mean, wherever mirrors are.
template <Accelerator A>
PhotonTrace trace_aimed_photons(const A& accelerator, const LitScene& lit, const LightTable& lights,
                                const PhotonConfig& config) {
    const MirrorTable mirrors = MirrorTable::of(lit);
    if (mirrors.triangles.empty() || lights.lights().empty()) return {};
    return trace_each(config, aimed_stream, [&](Sampler& sampler, PhotonTrace& trace) {
        const TriangleLight& light = lights.choose(sampler.next());
        const Double3 from = uniform_point(light.triangle, sampler.next_pair());
        const std::uint32_t mirror = mirrors.choose(sampler.next());
        const Triangle& triangle = lit.triangles[mirror];
        const Double3 way = uniform_point(triangle, sampler.next_pair()) - from;
        const double square = glm::dot(way, way);
        const Double3 to = way / std::sqrt(square);
        const double cosines =
            glm::dot(light.normal, to) * std::abs(glm::dot(glm::normalize(normal(triangle)), to));
        if (!(cosines > 0.0)) return void(++trace.counts.stopped);
        const double areas = light.area / light.probability * mirrors.area();
        trace_photon(accelerator, lit, photon_ray(light, from, to),
                     cosines / square * areas / config.count * light.radiance, sampler, config,
                     trace, mirror);
    });
}
// [aim]

}  // namespace space
