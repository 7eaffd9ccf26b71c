/// @file
/// Signs that double loses, on volumes of whole numbers whose exact value is known beforehand; and
/// how near an error has come to the filter's bound.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/measured/data.hpp"
#include "common/pcg32.hpp"

#include <array>

namespace space::ch02 {

/// Three vectors of whole numbers below 10^6, which floats hold without rounding.
struct WholeVectors {
    Vector3 s, e, d;
};

// [sign_example]
/// A quadrilateral that is cut into two triangles along its diagonal from
/// (0, 0, 0) to b; and a ray.
inline constexpr Point3 example_b{944'507, 210'541, 580'784};
inline constexpr Point3 example_c{808'053, 365'176, 337'353};
inline constexpr Point3 example_d{136'454, -154'635, 243'431};
inline constexpr Triangle first_triangle{{0, 0, 0}, example_b, example_c};
inline constexpr Triangle second_triangle{example_b, {0, 0, 0}, example_d};
inline constexpr Ray example_ray{.origin = {142'669, 715'325, 803'519},
                                 .direction = {125'874, -228'781, -191'564}};
// [sign_example]

/// On which side of the diagonal the ray passes, and which triangles it is said to hit.
SignExample sign_example();

/// (s x e) . d in float, in double and exactly, and the bound of double's error: seven roundings on
/// each term's way.
Volume volume_of(const WholeVectors& vectors);

/// Vectors with this exact volume: d solves d . (s x e) = volume for random s and e.
WholeVectors with_volume(std::int64_t volume, Pcg32& random);

/// Volumes from -100 to 100 without 0.
LostSigns lost_signs(std::uint64_t volumes, std::uint64_t seed);

/// The largest error of FilteredExact's outside(...) on some inputs that were bred for it, as a
/// part of its bound.
double worst_known_share();

/// Origin, direction and corners.
using FilterInput = std::array<Vector3, 5>;
/// The worst of some ten million inputs for u, for v and for t; then seven that were bred for other
/// bounds by other hands.
extern const std::array<FilterInput, 10> bred_inputs;

}  // namespace space::ch02
