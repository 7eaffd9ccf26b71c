/// @file
/// A light chosen by what it emits, a point of it by area or by solid angle, and the densities of
/// both.
#pragma once

#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/spherical_triangle.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace space {

/// How bright a colour looks: its Y of CIE 1931, for the primaries of sRGB (IEC 61966-2-1).
inline double luminance(const Double3& color) {
    return glm::dot(color, Double3(0.2126, 0.7152, 0.0722));
}

/// A point of the triangle, uniform in area, for two uniform numbers: on a line parallel to the
/// edge from a to c, whose length grows with the distance from b.
inline Double3 uniform_point(const Triangle& triangle, const Double2& u) {
    const Double3 a{triangle.a}, b{triangle.b}, c{triangle.c};
    return glm::mix(b, glm::mix(a, c, u.x), std::sqrt(u.y));
}

/// A triangle that emits from its front, and how often it is chosen.
struct TriangleLight {
    Triangle triangle;
    std::uint32_t index;  ///< in the scene
    Double3 normal;       ///< of the front, of length 1
    Double3 radiance;
    double area;
    double probability;  ///< its share of the power: radiance's luminance times area
    double before;       ///< the sum of the probabilities of the lights before it
};

/// The lights of a scene that have an area. A plain value; asking it changes nothing.
class LightTable {
  public:
    explicit LightTable(const LitScene& lit) {
        double power = 0.0;
        for (const std::uint32_t i : lit.lights) {
            const Double3 n = normal(lit.triangles[i]), radiance = lit.emitted(i, true);
            const double area = 0.5 * glm::length(n), share = luminance(radiance) * area;
            if (!(share > 0.0)) continue;
            lights_.push_back({.triangle = lit.triangles[i],
                               .index = i,
                               .normal = glm::normalize(n),
                               .radiance = radiance,
                               .area = area,
                               .probability = share,
                               .before = power});
            power += share;
        }
        for (TriangleLight& light : lights_) {
            light.probability /= power;
            light.before /= power;
        }
    }

    std::span<const TriangleLight> lights() const { return lights_; }

    // [choose_light]
    /// The light on whose part of [0, 1) the number u lies: each is as likely as its share of the
    /// power. There must be a light.
    const TriangleLight& choose(double u) const {
        const auto after =
            std::upper_bound(lights_.begin(), lights_.end(), u,
                             [](double x, const TriangleLight& light) { return x < light.before; });
        return after[-1];
    }
    // [choose_light]

    /// The light that is this triangle of the scene; null where it is none.
    const TriangleLight* find(std::uint32_t triangle) const {
        const auto at = std::lower_bound(
            lights_.begin(), lights_.end(), triangle,
            [](const TriangleLight& light, std::uint32_t t) { return light.index < t; });
        return at != lights_.end() && at->index == triangle ? &*at : nullptr;
    }

    /// The flux of all lights, RGB: pi times radiance times area, summed (Lambert's law).
    Double3 flux() const {
        Double3 sum{0.0};
        for (const TriangleLight& light : lights_) sum += light.area * light.radiance;
        return std::numbers::pi * sum;
    }

  private:
    std::vector<TriangleLight> lights_;  ///< by index
};

/// A point of a light as a point of the scene sees it, whatever stands between. Where it is not
/// lit, it sees no front of that light, and nothing else here has a meaning.
struct LightSample {
    Double3 point{0.0};
    Double3 direction{0.0};  ///< of length 1, towards the light
    double distance = 0.0;
    double pdf = 0.0;  ///< of the direction, per solid angle; positive where lit
    Double3 radiance{0.0};
    const TriangleLight* light = nullptr;
    bool is_lit = false;
};

namespace light_sampling {

/// With `density`(cosine at the light, distance) of the direction.
template <class Density>
LightSample towards(const TriangleLight& light, const Double3& to, const Double3& from,
                    const Density& density) {
    LightSample sample{.point = from + to, .radiance = light.radiance, .light = &light};
    sample.distance = glm::length(to);
    sample.direction = to / sample.distance;
    const double cosine = -glm::dot(light.normal, sample.direction);
    if (cosine > 0.0) sample.pdf = density(cosine, sample.distance);
    sample.is_lit = sample.pdf > 0.0 && std::isfinite(sample.pdf);
    return sample;
}

}  // namespace light_sampling

/// The density of a direction per solid angle where its point is uniform in the light's area: that
/// area looks smaller by the cosine, and by the square of the distance.
inline double area_pdf(const TriangleLight& light, double cosine, double distance) {
    return light.probability / light.area * distance * distance / cosine;
}
/// The same where it is uniform in the light's solid angle; 0 where the point is not before it.
inline double solid_angle_pdf(const TriangleLight& light, const SphericalTriangle& seen) {
    return seen.volume < 0.0 && seen.solid_angle > 0.0 ? light.probability / seen.solid_angle : 0.0;
}

/// A light chosen by `choice` and a point uniform in its area; `choice` and `u` are uniform numbers
/// in [0, 1).
inline LightSample sample_light_area(const LightTable& table, const Double3& from, double choice,
                                     const Double2& u) {
    const TriangleLight& light = table.choose(choice);
    const Double3 to = uniform_point(light.triangle, u) - from;
    return light_sampling::towards(light, to, from, [&](double cosine, double distance) {
        return area_pdf(light, cosine, distance);
    });
}

/// A light chosen by `choice` and a point uniform in its solid angle; `choice` and `u` are uniform
/// numbers in [0, 1).
inline LightSample sample_light_solid_angle(const LightTable& table, const Double3& from,
                                            double choice, const Double2& u) {
    const TriangleLight& light = table.choose(choice);
    const SphericalTriangle seen(light.triangle, from);
    if (solid_angle_pdf(light, seen) == 0.0) return {};
    return light_sampling::towards(light, sample_solid_angle(seen, u), from,
                                   [&](double, double) { return solid_angle_pdf(light, seen); });
}

}  // namespace space
