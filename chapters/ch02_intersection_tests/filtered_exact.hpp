/// @file
/// The ray-triangle test whose decision is always that of exact arithmetic on the float inputs: a
/// filter in double decides nearly every ray, 128-bit integers the next few, exact expansions the
/// rest.
#pragma once

#include "chapters/ch02_intersection_tests/expansion.hpp"
#include "common/accelerator.hpp"

#include <algorithm>
#include <bit>
#include <optional>

namespace space {

/// Which stage decided: for the chapter's table of shares.
enum class Stage { filter, integers, expansions };

/// Asks for no record of the stages.
struct NoStages {
    static constexpr void decided(Stage) {}
};

/// Hit or miss as in exact arithmetic, on closed triangles: a ray through a shared edge or vertex
/// of a closed mesh hits every triangle there. A triangle without area, or seen exactly edge-on, is
/// not hit. t is the float nearest to the exact t, ties to even, and it is this float that must lie
/// in [tmin, tmax], as in chapter 1.
struct FilteredExact {
    template <class Stages = NoStages>
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle,
                                        Stages&& stages = {}) {
        // [filter]
        const Double3 a{triangle.a}, d{ray.direction};
        const Double3 e1 = Double3(triangle.b) - a, e2 = Double3(triangle.c) - a,
                      s = Double3(ray.origin) - a;
        const Sizes size = sizes(d, e1, e2, s);
        const double bound = outside_bound(size);

        const Double3 p = glm::cross(d, e2);
        const double det = glm::dot(p, e1), u = glm::dot(p, s), u_outside = outside(u, det);
        if (u_outside > bound) return decided(stages, Stage::filter);
        const Double3 q = glm::cross(s, e1);
        const double v = glm::dot(q, d), v_outside = outside(v, det - u);
        if (v_outside > bound) return decided(stages, Stage::filter);
        if (u_outside < -bound && v_outside < -bound) {
            const double inverse = 1.0 / det, t = glm::dot(q, e2) * inverse;
            const double slack = t_bound(size, t, inverse);
            if (const auto nearest = common_float(t - slack, t + slack))
                return decided(stages, Stage::filter, hit(ray, *nearest, u * inverse, v * inverse));
        }
        // [filter]
        return by_integers(ray, triangle, stages);
    }

    /// How far x lies outside of the interval between 0 and `end`: negative inside, 0 at both ends.
    static double outside(double x, double end) {
        const double half = 0.5 * end;
        return std::abs(x - half) - std::abs(half);
    }
    /// The vectors' 1-norms, rounded.
    struct Sizes {
        double d, e1, e2, s;
    };
    static Sizes sizes(const Double3& d, const Double3& e1, const Double3& e2, const Double3& s) {
        return {one_norm(d), one_norm(e1), one_norm(e2), one_norm(s)};
    }
    /// Above the error of outside(u, det) and of outside(v, det - u).
    ///
    /// With u53 = 2^-53 and gamma(n) = n u53 / (1 - n u53): each volume is a sum of products of
    /// three vectors' components. A computed term of det, u and v carries seven roundings, two
    /// differences (the direction is none), two products, three sums; so a volume is off by at most
    /// gamma(7) times the sum of its terms' sizes, which is at most |d||e1||e2| in det, |d||e2||s|
    /// in u and |d||e1||s| in v. `outside` passes on the errors of x and of end; the roundings of
    /// det - u, of x - half and of the last difference add u53 |det - u|, u53 |x - half| and u53
    /// |x|. All in all at most 9 u53 |d| (|e1||e2| + (|e1| + |e2|) |s|) and terms with u53^2; the
    /// tenth is far more than those and the rounding of the bound itself take. Nothing under- or
    /// overflows: products of three floats and of the bound stay within 2^-510 .. 2^400.
    static double outside_bound(const Sizes& size) {
        return 10.0 * 0x1p-53 * size.d * (size.e1 * size.e2 + (size.e1 + size.e2) * size.s);
    }
    /// Above the distance of an exact t of a certain hit from the ends t - slack and t + slack.
    ///
    /// With T and D exact, T' and det computed, |T / D - T' / det| <= (|T' - T| + |T' / det|
    /// |det - D|) / |D|. T' has eight roundings: |T' - T| <= gamma(8) |e1||e2||s|, and |det - D| <=
    /// gamma(7) |d||e1||e2|. Where outside(u, det) < -bound, half of |det| is above the bound, so
    /// |D| > 13/20 |det|: at most 12.4 u53 |e1||e2||s| / |det| and 10.8 u53 |t||d||e1||e2| / |det|.
    /// The roundings of the reciprocal, of t and of t - slack add 3 u53 |t|, and |det| <=
    /// |d||e1||e2| but for roundings: 13.8 u53 of the second. `inverse` is 1 / det. A slack that
    /// overflows passes the ray on; one that underflows stands beside a t far below the smallest
    /// float.
    // [t_bound]
    static double t_bound(const Sizes& size, double t, double inverse) {
        return 14.0 * 0x1p-53 * size.e1 * size.e2 * (size.s + std::abs(t) * size.d) *
               std::abs(inverse);
    }
    // [t_bound]

  private:
    static double one_norm(const Double3& v) {
        return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    }

    /// The float nearest to every number from low to high, if they share it.
    static std::optional<float> common_float(double low, double high) {
        const auto nearest = static_cast<float>(low);
        return nearest == static_cast<float>(high) ? std::optional(nearest) : std::nullopt;
    }
    static std::optional<Hit> hit(const Ray& ray, float t, double u, double v) {
        if (!(t >= ray.tmin && t <= ray.tmax)) return std::nullopt;
        return Hit{.t = t, .u = static_cast<float>(u), .v = static_cast<float>(v)};
    }
    template <class Stages>
    static std::optional<Hit> decided(Stages& stages, Stage stage, std::optional<Hit> answer = {}) {
        stages.decided(stage);
        return answer;
    }

    // Not inlined: what is hardly ever run would make the loops around the filter long.
    template <class Stages>
    [[gnu::noinline]] static std::optional<Hit> by_integers(const Ray& ray,
                                                            const Triangle& triangle,
                                                            Stages& stages);
    template <class Stages>
    static std::optional<Hit> by_expansions(const Ray& ray, const Triangle& triangle,
                                            Stages& stages);
};

__extension__ typedef __int128 Int128;
inline int sign(Int128 value) {
    return (value > 0) - (value < 0);
}
inline double to_double(Int128 value) {
    return static_cast<double>(value);
}
template <std::size_t N>
int sign(const Expansion<N>& value) {
    return value.sign();
}
template <std::size_t N>
double to_double(const Expansion<N>& value) {
    return value.value();
}

/// Three exact numbers. glm's vectors hold floating-point types only.
template <class Number>
struct Exact3 {
    Number x, y, z;
};
template <class A, class B>
auto cross(const Exact3<A>& a, const Exact3<B>& b) {
    return Exact3<decltype(a.y * b.z - a.z * b.y)>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                                   a.x * b.y - a.y * b.x};
}
template <class A, class B>
auto dot(const Exact3<A>& a, const Exact3<B>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The four volumes of Möller & Trumbore in exact numbers, and what they decide about the ray's
/// line.
template <class D, class E>
struct ExactVolumes {
    decltype(dot(cross(std::declval<D>(), std::declval<E>()), std::declval<E>())) det, u, v;
    decltype(dot(cross(std::declval<E>(), std::declval<E>()), std::declval<E>())) t;

    ExactVolumes(const D& d, const E& s, const E& e1, const E& e2) {
        const auto p = cross(d, e2);
        const auto q = cross(s, e1);
        det = dot(p, e1);
        u = dot(p, s);
        v = dot(q, d);
        t = dot(q, e2);
    }
    bool line_hits() const {
        const int side = sign(det);
        return side != 0 && sign(u) * side >= 0 && sign(v) * side >= 0 &&
               sign(det - u - v) * side >= 0;
    }
};

/// Floats as integers times 2^exponent, where `bits` bits hold them all.
struct CommonScale {
    int lowest = 1000,
        highest = -1000;  ///< exponents of the lowest bit that is set, and above the highest

    void cover(const Point3& p) {
        for (int axis = 0; axis < 3; ++axis) {
            if (p[axis] == 0.0f) continue;
            int exponent = 0;  // a denormal float is a normal double
            const auto mantissa = static_cast<std::uint32_t>(
                std::abs(std::frexp(double{p[axis]}, &exponent)) * 0x1p24);
            lowest = std::min(lowest, exponent - 24 + std::countr_zero(mantissa));
            highest = std::max(highest, exponent);
        }
    }
    int bits() const { return std::max(highest - lowest, 0); }
    Exact3<Int128> scaled(const Point3& p) const {
        const auto integer = [&](float x) {
            return static_cast<Int128>(std::ldexp(static_cast<double>(x), -lowest));
        };
        return {integer(p.x), integer(p.y), integer(p.z)};
    }
};

template <class Stages>
std::optional<Hit> FilteredExact::by_integers(const Ray& ray, const Triangle& triangle,
                                              Stages& stages) {
    if (!is_valid(ray) || !is_finite<3>(triangle.a) || !is_finite<3>(triangle.b) ||
        !is_finite<3>(triangle.c))
        return decided(stages,
                       Stage::filter);  // what is not a number fails every comparison of the filter
    CommonScale place, way;
    place.cover(ray.origin);
    place.cover(triangle.a);
    place.cover(triangle.b);
    place.cover(triangle.c);
    way.cover(ray.direction);
    // Differences have one bit more. A determinant of three rows with entries between -1 and 1 is
    // between -4 and 4 (it is linear in each entry, so the worst have entries +-1). det, u, v, det
    // - u and det - u - v are such determinants, their partial sums are some with zeros: two bits
    // more than the three factors have. t needs one: three differences from one corner span at most
    // twice the volume of the cube that holds them. There are 127 bits and a sign.
    const int edge_bits = place.bits() + 1;
    if (2 * edge_bits + way.bits() + 2 > 127 || 3 * edge_bits + 1 > 127)
        return by_expansions(ray, triangle, stages);

    const Exact3<Int128> a = place.scaled(triangle.a), b = place.scaled(triangle.b),
                         c = place.scaled(triangle.c);
    const Exact3<Int128> o = place.scaled(ray.origin);
    const auto minus = [](const Exact3<Int128>& x, const Exact3<Int128>& y) {
        return Exact3<Int128>{x.x - y.x, x.y - y.y, x.z - y.z};
    };
    const ExactVolumes<Exact3<Int128>, Exact3<Int128>> volumes(
        way.scaled(ray.direction), minus(o, a), minus(b, a), minus(c, a));
    if (!volumes.line_hits()) return decided(stages, Stage::integers);

    const double det = to_double(volumes.det);
    const double t = std::ldexp(to_double(volumes.t) / det, place.lowest - way.lowest);
    const double slack = 0x1p-50 * std::abs(t);  // three roundings
    if (const auto nearest = common_float(t - slack, t + slack))
        return decided(stages, Stage::integers,
                       hit(ray, *nearest, to_double(volumes.u) / det, to_double(volumes.v) / det));
    return by_expansions(ray, triangle, stages);
}

/// The volumes in expansions: whatever the exponents.
inline auto expansion_volumes(const Ray& ray, const Triangle& triangle) {
    const auto minus = [](const Point3& x, const Point3& y) {
        return Exact3<Expansion<2>>{difference(x.x, y.x), difference(x.y, y.y),
                                    difference(x.z, y.z)};
    };
    const auto one = [](double x) {
        Expansion<1> result;
        result.push(x);
        return result;
    };
    const Vector3& d = ray.direction;
    const auto e1 = minus(triangle.b, triangle.a), e2 = minus(triangle.c, triangle.a);
    return ExactVolumes<Exact3<Expansion<1>>, Exact3<Expansion<2>>>(
        {one(d.x), one(d.y), one(d.z)}, minus(ray.origin, triangle.a), e1, e2);
}

template <class Stages>
std::optional<Hit> FilteredExact::by_expansions(const Ray& ray, const Triangle& triangle,
                                                Stages& stages) {
    const auto volumes = expansion_volumes(ray, triangle);
    if (!volumes.line_hits()) return decided(stages, Stage::expansions);

    const double det = to_double(volumes.det), t = to_double(volumes.t) / det,
                 slack = 0x1p-50 * std::abs(t);
    const auto low = static_cast<float>(t - slack), high = static_cast<float>(t + slack);
    auto nearest = static_cast<float>(t);
    if (low != high) {  // which side of their middle? t middle = ties to even
        // Infinity begins where the next float would be.
        const auto place = [](float f) {
            return std::isinf(f) ? std::copysign(0x1p128, double{f}) : double{f};
        };
        const double middle = 0.5 * (place(low) + place(high));
        const int above = sign(volumes.t - volumes.det * middle) * sign(volumes.det);
        nearest = above < 0 ? low : above > 0 ? high : static_cast<float>(middle);
    }
    return decided(stages, Stage::expansions,
                   hit(ray, nearest, to_double(volumes.u) / det, to_double(volumes.v) / det));
}

}  // namespace space
