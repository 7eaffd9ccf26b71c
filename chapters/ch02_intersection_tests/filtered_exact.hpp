/// @file
/// The ray-triangle test whose decision is always that of exact arithmetic on the float inputs: a
/// filter in double decides nearly every ray, 128-bit integers the next few, exact expansions the
/// rest.
#pragma once

#include "chapters/ch02_intersection_tests/expansion.hpp"
#include "common/accelerator.hpp"

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
        const Double3 p = glm::cross(d, e2);
        const double det = glm::dot(p, e1), side = std::copysign(1.0, det), size = side * det;
        const double u = side * glm::dot(p, s);
        const double length = one_norm(e1) + one_norm(e2);
        const double bound = volume_error * one_norm(d) * length * (length + one_norm(s));
        if (size > bound) {  // the sign of det is right
            if (u < -bound || u > size + bound) return decided(stages, Stage::filter);
            const Double3 q = glm::cross(s, e1);
            const double v = side * glm::dot(q, d);
            if (v < -bound || u + v > size + bound) return decided(stages, Stage::filter);
            if (u > bound && v > bound && u + v < size - bound) {
                const double inverse = 1.0 / size, t = side * glm::dot(q, e2) * inverse;
                const double t_bound = volume_error * length * length * one_norm(s);
                const double slack = 2.0 * (t_bound + std::abs(t) * bound) * inverse;
                if (const auto nearest = common_float(t - slack, t + slack))
                    return decided(stages, Stage::filter,
                                   hit(ray, *nearest, u * inverse, v * inverse));
            }
        }
        // [filter]
        return by_integers(ray, triangle, stages);
    }

  private:
    /// Each volume is a sum of products of three vectors' components. A computed term carries at
    /// most eight roundings: three differences (two where d is a factor), two products, three sums;
    /// so the error of a volume is at most gamma(8) times the sum of its terms' sizes, gamma(n) = n
    /// u / (1 - n u), u = 2^-53. In 1-norms these sizes add up to at most |d| |e2| |e1| in det, |d|
    /// |e2| |s| in u, |d| |e1| |s| in v: all three together are below |d| (|e1| + |e2|) (|e1| +
    /// |e2| + |s|). Eight more than cover the sums u + v and size + bound and the bound's own
    /// roundings. Nothing under- or overflows: products of three floats and of the bound stay
    /// within 2^-500 .. 2^400.
    static constexpr double volume_error = 16.0 * 0x1p-53;
    // A hit's `size` is more than three bounds, so the exact D is more than 2/3 of it. With T and D
    // exact, T' and D' computed, |T / D - T' / D'| = |T' (D' - D) - (T' - T) D'| / (D D') <= 3/2
    // (|t| bound + t_bound) / size. The quarter of `slack` that is left is at least 8 u |t|, for
    // the roundings of t and of slack.

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

    template <class Stages>
    static std::optional<Hit> by_integers(const Ray& ray, const Triangle& triangle, Stages& stages);
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
            const auto pattern = std::bit_cast<std::uint32_t>(p[axis]);
            const std::uint32_t biased = (pattern >> 23) & 0xFF;
            const std::uint32_t mantissa = (pattern & 0x7FFFFF) | (biased ? 0x800000u : 0u);
            const int exponent = static_cast<int>(biased ? biased : 1) - 150;  // of the last place
            lowest = std::min(lowest, exponent + std::countr_zero(mantissa));
            highest = std::max(highest, exponent + static_cast<int>(std::bit_width(mantissa)));
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
    // Differences have one bit more; a volume has six terms, u + v - det eighteen: five bits more
    // than its three factors. A sign bit is left.
    const int edge_bits = place.bits() + 1;
    if (2 * edge_bits + way.bits() + 5 > 126 || 3 * edge_bits + 3 > 126)
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
