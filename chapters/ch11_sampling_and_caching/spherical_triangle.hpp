/// @file
/// A triangle as a point sees it: the part of the sphere of directions that it covers, and points
/// of it that are uniform in solid angle.
#pragma once

#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace space {

/// The vectors from a point to a triangle's corners, their lengths, and the solid angle.
///
/// `volume` is a . ((b - a) x (c - a)): six times the tetrahedron's volume, with edges that floats
/// give exactly, so that nothing cancels where the triangle is far away or small. It is positive
/// where the point is on the triangle's back side, negative on its front.
struct SphericalTriangle {
    Double3 a, b, c;
    double a_length, b_length, c_length;
    double volume;
    double solid_angle;  ///< from 0 to 2 pi

    SphericalTriangle(const Triangle& triangle, const Double3& point)
        : a(Double3(triangle.a) - point),
          b(Double3(triangle.b) - point),
          c(Double3(triangle.c) - point),
          a_length(glm::length(a)),
          b_length(glm::length(b)),
          c_length(glm::length(c)),
          volume(glm::dot(a, normal(triangle))),
          solid_angle(2.0 * std::atan2(std::abs(volume), denominator())) {}

    /// Of the tangent of half the solid angle (van Oosterom & Strackee 1983, eq. 8); the published
    /// sum of three angles minus pi loses all digits where the triangle covers little.
    double denominator() const {
        return a_length * b_length * c_length + glm::dot(a, b) * c_length +
               glm::dot(b, c) * a_length + glm::dot(c, a) * b_length;
    }
};

/// The point of the edge from p to q (lengths |p| and |q|) in the direction (1 - s) p / |p| +
/// s q / |q|; q where s is no number, as for a point that lies between the ends of an arc.
inline Double3 on_edge(const Double3& p, double p_length, const Double3& q, double q_length,
                       double s) {
    const double p_part = (1.0 - s) * q_length, q_part = s * p_length;
    return p + std::max(0.0, std::min(1.0, q_part / (p_part + q_part))) * (q - p);
}

// [arvo]
/// A point of the triangle (as a vector from the point that sees it) whose direction is uniform in
/// the solid angle, for two uniform numbers: Arvo 1995. First the point c' of the arc from a to c
/// whose triangle a b c' has the part u.x of the solid angle; then a point of the arc from b to c',
/// the cosine of whose angle to b is uniform.
///
/// Arvo takes both from angles, which lose their digits where the triangle is small. Here each arc
/// is followed along its chord. With unit vectors a, b, c and m = a + s (c - a) in the direction of
/// c', the formula of van Oosterom and Strackee gives tan(part / 2) = s det(a, b, c) / ((1 + a.b)
/// |m| + (a + b).m); squared, as |m|^2 = 1 - s q + s^2 q with q = |c - a|^2, it is linear in s.
/// On the other arc let Q = |c' - b|^2 and z = 1 - u.y Q / 2, the cosine; solving z |m| = b . m for
/// m = b + r (c' - b) gives r. In a triangle of no extent s = u.x and r = sqrt(u.y), which is
/// uniform in area: nothing has to be treated apart.
inline Double3 sample_solid_angle(const SphericalTriangle& seen, const Double2& u) {
    const Double3 a = seen.a / seen.a_length, b = seen.b / seen.b_length,
                  c = seen.c / seen.c_length;
    const Double2 half = circle_point(u.x * seen.solid_angle / (4.0 * std::numbers::pi));
    const double det = std::abs(seen.volume) / (seen.a_length * seen.b_length * seen.c_length);
    const double k = 1.0 + glm::dot(a, b), q = glm::dot(c - a, c - a);
    const double g = half.x * det - half.y * glm::dot(a + b, c - a), tk = half.y * k;
    const double s = tk * (2.0 * g - tk * q) / (g * g - tk * tk * q);
    const Double3 to = on_edge(seen.a, seen.a_length, seen.c, seen.c_length, s);

    const double to_length = glm::length(to);
    const Double3 sum = b + to / to_length, chord = to / to_length - b;
    const double rest = glm::dot(sum, sum), square = glm::dot(chord, chord);  // they add up to 4
    const double z = 1.0 - 0.5 * u.y * square, e = std::sqrt(u.y * (1.0 - 0.25 * u.y * square));
    const double r = 2.0 * e / (e * square + z * std::sqrt(rest));
    return on_edge(seen.b, seen.b_length, to, to_length, r);
}
// [arvo]

}  // namespace space
