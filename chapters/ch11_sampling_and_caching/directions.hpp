/// @file
/// Directions over a surface, and how densely each way of choosing them covers them. Densities are
/// per solid angle: their integral over the hemisphere is 1.
#pragma once

#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace space {

/// A direction of length 1 and the density with which it was chosen.
struct DirectionSample {
    Double3 direction{0.0};
    double pdf = 0.0;
};

/// Cosine and sine of this part of a turn, `turns` in [0, 1): their Taylor series within an eighth
/// of a turn, to terms below 2^-53. The library's functions are as near, but not the same on every
/// machine.
inline Double2 circle_point(double turns) {
    static constexpr auto reciprocals = [] {
        std::array<double, 18> r{};
        for (int n = 1; n < 18; ++n) r[static_cast<std::size_t>(n)] = 1.0 / (n * (n + 1));
        return r;
    }();
    const int quarter = static_cast<int>(4.0 * turns + 0.5);
    const double x = (4.0 * turns - quarter) * (0.5 * std::numbers::pi), square = x * x;
    double cosine = 1.0, sine = 1.0;
    for (std::size_t n = 16; n > 0; n -= 2) {
        cosine = 1.0 - square * reciprocals[n - 1] * cosine;
        sine = 1.0 - square * reciprocals[n] * sine;
    }
    sine *= x;
    switch (quarter % 4) {
        case 0:
            return {cosine, sine};
        case 1:
            return {-sine, cosine};
        case 2:
            return {-cosine, -sine};
        default:
            return {sine, -cosine};
    }
}

/// Three unit vectors at right angles, x cross y = z.
struct Basis {
    Double3 x, y, z;

    /// Around a normal of length 1 (Duff et al. 2017): no root and no division by less than 1.
    explicit Basis(const Double3& n) : z(n) {
        const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
        x = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        y = {b, sign + n.y * n.y * a, -n.y};
    }
    Double3 to_world(const Double3& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// The direction at this height over the surface with normal n, `turns` of the way around it.
inline Double3 direction_at(const Double3& n, double height, double turns) {
    const double radius = std::sqrt(std::max(0.0, (1.0 - height) * (1.0 + height)));
    const Double2 around = circle_point(turns);
    return Basis(n).to_world({radius * around.x, radius * around.y, height});
}

/// Every direction over the surface alike: heights on a sphere are uniform (Archimedes).
/// @param n of length 1  @param u two uniform numbers in [0, 1)
inline DirectionSample uniform_hemisphere(const Double3& n, const Double2& u) {
    return {direction_at(n, 1.0 - u.x, u.y), 0.5 / std::numbers::pi};
}
inline double uniform_hemisphere_pdf(const Double3& n, const Double3& direction) {
    return glm::dot(n, direction) > 0.0 ? 0.5 / std::numbers::pi : 0.0;
}

// [malley]
/// In proportion to the cosine with the normal, as light counts in irradiance: points uniform on a
/// disc, lifted to the hemisphere above it (Malley's method). u.x is the square of the radius, and
/// 1 - u.x that of the height.
inline DirectionSample cosine_hemisphere(const Double3& n, const Double2& u) {
    const double height = std::sqrt(1.0 - u.x);
    return {direction_at(n, height, u.y), height / std::numbers::pi};
}
// [malley]
inline double cosine_hemisphere_pdf(const Double3& n, const Double3& direction) {
    return std::max(0.0, glm::dot(n, direction)) / std::numbers::pi;
}

/// Where a mirror of normal n (of length 1, either side) sends what comes along `direction`.
inline Double3 mirrored(const Double3& direction, const Double3& n) {
    return direction - 2.0 * glm::dot(direction, n) * n;
}

}  // namespace space
