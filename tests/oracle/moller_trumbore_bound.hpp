/// @file
/// How wrong Möller-Trumbore in double can be: the bound that its decisions are tested against.
///
/// Let e = 2^-53, and let the permanent of three vectors be their determinant with every term made
/// positive. One term of p . ab = (direction x ac) . ab collects the roundings of ac, of a product
/// and of a difference (in p), of ab, of a product and of two sums: 7, so that the computed value
/// differs from the exact one by at most
///     7 e perm(direction, ac, ab) + O(e^2)  <  8 e perm(direction, ac, ab).
/// p . s and q . direction are counted alike (7), q . ac has one rounding more (8, < 9 e). Floats,
/// their differences and products of three or four of them are far from the ends of double's range,
/// so nothing over- or underflows.
///
/// Let D, U, V, T be the exact determinant and numerators, D + dD ... the computed ones. Where the
/// code accepts, it has seen u' = (U + dU) / (D + dD) in [0, 1], so the exact weight is u = U / D =
/// u' + (u' dD - dU) / D, off by at most
/// (|dD| + |dU|) / |D|; the quotient's own rounding adds e. Where it rejects because of u' < 0
/// while u >= 0, either |dU| >= |U| or |dD| >= |D|; because of u' > 1 while u <= 1, 1 - u <= (|dD|
/// + |dU|) / |D|. The same for v, and for the third weight the errors of u and v and the sum's
/// rounding add up. So a wrong decision needs an exact weight within
///     weight = (2 * 8 e perm(direction, ac, ab) + 8 e perm(direction, ac, s) + 8 e perm(direction,
///     ab, s)) / |D| + 4 e
/// of zero, and t is off by at most
///     t = (|t| 8 e perm(direction, ac, ab) + 9 e perm(s, ab, ac)) / |D| + 2 e |t|   before it is
///     rounded to float.
/// Where |D| is no larger than its own error both bounds exceed 1/2 and say that anything may
/// happen: the triangle is seen edge-on to within rounding.
#pragma once

#include "tests/oracle/exact.hpp"

namespace space {

struct MollerTrumboreBound {
    double weight;  ///< of u, v and w = 1 - u - v
    double t;
};

namespace detail {
inline double permanent(const Double3& a, const Double3& b, const Double3& c) {
    return (a.y * b.z + a.z * b.y) * c.x + (a.z * b.x + a.x * b.z) * c.y +
           (a.x * b.y + a.y * b.x) * c.z;
}
}  // namespace detail

inline MollerTrumboreBound moller_trumbore_bound(const Ray& ray, const Triangle& triangle,
                                                 const Crossing& exact) {
    using detail::permanent;
    constexpr double e = 0x1p-53;
    const Double3 direction = glm::abs(Double3(ray.direction)), a{triangle.a};
    const Double3 ab = glm::abs(Double3(triangle.b) - a), ac = glm::abs(Double3(triangle.c) - a);
    const Double3 s = glm::abs(Double3(ray.origin) - a);
    const double determinant = std::abs(exact.determinant),
                 determinant_error = 8 * e * permanent(direction, ac, ab);
    const double weights_error =
        8 * e * (permanent(direction, ac, s) + permanent(direction, ab, s));
    const double t = std::abs(exact.t);
    return {.weight = (2 * determinant_error + weights_error) / determinant + 4 * e,
            .t = (t * determinant_error + 9 * e * permanent(s, ab, ac)) / determinant + 2 * e * t};
}

}  // namespace space
