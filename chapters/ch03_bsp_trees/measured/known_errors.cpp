#include "chapters/ch03_bsp_trees/measured/known_errors.hpp"

#include "chapters/ch03_bsp_trees/split_plane.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>

namespace space::ch03 {
namespace {

using Exact3 = std::array<mpq_class, 3>;

Exact3 exact(const Vector3& v) {
    return {mpq_class(double{v.x}), mpq_class(double{v.y}), mpq_class(double{v.z})};
}
Exact3 difference(const Exact3& a, const Exact3& b) {
    return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
mpq_class volume(const Exact3& e, const Exact3& f, const Exact3& s) {
    return (e[1] * f[2] - e[2] * f[1]) * s[0] + (e[2] * f[0] - e[0] * f[2]) * s[1] +
           (e[0] * f[1] - e[1] * f[0]) * s[2];
}

/// Of the estimate along the normal of the plane through the first three points; of the fourth's
/// height over it, or of the fourth as a vector.
double share(const std::array<float, 12>& numbers, bool height) {
    const auto point = [&](std::size_t i) {
        return Point3(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
    };
    const Triangle through{point(0), point(1), point(2)};
    const Exact3 from = exact(through.a);
    const Double3 way = Double3(point(3)) - (height ? Double3(through.a) : Double3(0.0));
    const Exact3 exact_way = height ? difference(exact(point(3)), from) : exact(point(3));
    const Estimate computed = along_normal(SplitPlane<3>(through), way);
    const mpq_class truth = volume(difference(exact(through.b), from),
                                   difference(exact(through.c), from), exact_way),
                    off = (mpq_class(computed.value) - truth) / mpq_class(computed.error);
    return std::abs(off.get_d());
}

}  // namespace

double worst_known_share() {
    return std::max(share(worst_height, true), share(worst_slope, false));
}

}  // namespace space::ch03
