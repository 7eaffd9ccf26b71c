/// @file
/// One record of the radiance cache: the light that arrives at one point, how fast that changes
/// around it, and how far it may be used. Ward, Rubinstein and Clear 1988 ("A Ray Tracing Solution
/// for Diffuse Interreflection", sections 3 and 4); the gradients: Ward and Heckbert 1992
/// ("Irradiance Gradients").
#pragma once

#include "chapters/ch01_naive_ray_tracing/shading.hpp"  // float_roundoff
#include "common/geometry.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace space {

/// Irradiance (RGB; pi in each colour under a sky of radiance 1) on the side of the normal, which
/// has length 1. A row of a gradient is that of one colour.
struct IrradianceRecord {
    Double3 position{0.0}, normal{0.0, 0.0, 1.0};
    Double3 irradiance{0.0};
    double radius = 0.0;                   ///< mean distance of what is seen, 0 to infinity
    double nearest = infinity;             ///< distance of the nearest surface in front, if known
    glm::dmat3 translation_gradient{0.0};  ///< by a step of the point, per unit of length
    glm::dmat3 rotation_gradient{0.0};     ///< by a turn of the normal, per radian about an axis
};

// [split_sphere]
/// How much the irradiance at x, with the normal n, may differ from the record's, as a part of it:
/// at most so much, were all around the record a sphere of its radius, half of it bright and half
/// dark, and x on the way to where that tells most. (Ward, Rubinstein and Clear's estimate, without
/// its factors 4 / pi and sqrt 2, as their weight 1 / error has it; |n - n_i| / sqrt 2 is their
/// sqrt(1 - n . n_i).) 0 at the record itself, also where its radius is 0.
inline double split_sphere_error(const IrradianceRecord& record, const Double3& x,
                                 const Double3& n) {
    const double distance = glm::length(x - record.position);
    return (distance > 0.0 ? distance / record.radius : 0.0) +
           glm::length(n - record.normal) * std::sqrt(0.5);
}
// [split_sphere]

// [lies_in_front]
/// Whether the record may see what x can't, as a step's upper edge before its foot: it lies in
/// front of the surface at x, on the side of the normals' mean. A surface that bends between the
/// two by an angle t, in an edge or evenly, makes depths of up to |x - x_i| sin(t / 2), which do
/// not count; nor do those that come of the rounding of a plane's corners to floats.
inline bool lies_in_front(const IrradianceRecord& record, const Double3& x, const Double3& n) {
    const Double3 away = record.position - x;
    const double depth = 0.5 * glm::dot(away, n + record.normal);
    const double bend = 0.5 * glm::length(n - record.normal);
    const Double3 largest = glm::max(glm::abs(x), glm::abs(record.position));
    const double rounding = 4.0 * float_roundoff * std::max({largest.x, largest.y, largest.z});
    return depth > glm::length(away) * bend + rounding;
}
// [lies_in_front]

/// The irradiance at x, with the normal n, to first order; no colour below 0.
inline Double3 extrapolated(const IrradianceRecord& record, const Double3& x, const Double3& n) {
    const Double3 step = x - record.position, turn = glm::cross(record.normal, n);
    return glm::max(Double3(0.0), record.irradiance + record.translation_gradient * step +
                                      record.rotation_gradient * turn);
}

/// Between which bounds radii are kept, in units of the scene: 0 < smallest <= largest.
struct RadiusLimits {
    double smallest, largest;
};

// [limit_radius]
/// Keeps a radius usable: in a corner it may be 0, and under an open sky infinite. With gradients a
/// step of one radius may at most double the light or take all of it (colours added up): where it
/// changes faster, the radius shrinks; where that can't shrink so far, the gradient does.
inline void limit_radius(IrradianceRecord& record, const RadiusLimits& limits) {
    const glm::dmat3 of_colour = glm::transpose(record.translation_gradient);
    const double slope =
        glm::length(of_colour[0]) + glm::length(of_colour[1]) + glm::length(of_colour[2]);
    const double irradiance = record.irradiance.x + record.irradiance.y + record.irradiance.z;
    const double allowed = slope > 0.0 ? irradiance / slope : limits.largest;
    record.radius = std::max(limits.smallest, std::min({record.radius, allowed, limits.largest}));
    if (allowed < record.radius) record.translation_gradient *= allowed / record.radius;
}
// [limit_radius]

}  // namespace space
