// How wide the chapter's error bounds are: the largest error, as a part of its bound, that a climb
// finds over adversarial input, held against exact rational numbers. A bound is sound while the
// part stays below 1, and no wider than need be while it stays above its floor.
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "chapters/ch03_bsp_trees/exact_point.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace space {
namespace {

#ifdef BOOK_SANITIZED
constexpr int tries = 400;
#else
constexpr int tries = 20'000;
#endif

// ---- exact numbers

template <int D>
using Exact = std::array<mpq_class, D>;

template <int D, class Vector>
Exact<D> exact(const Vector& v) {
    Exact<D> result;
    for (int axis = 0; axis < D; ++axis) result[axis] = double{v[axis]};
    return result;
}
template <int D>
Exact<D> difference(const Exact<D>& a, const Exact<D>& b) {
    Exact<D> result;
    for (int axis = 0; axis < D; ++axis) result[axis] = a[axis] - b[axis];
    return result;
}
template <int D>
mpq_class product(const Exact<D>& a, const Exact<D>& b) {
    mpq_class sum = 0;
    for (int axis = 0; axis < D; ++axis) sum += a[axis] * b[axis];
    return sum;
}
template <int D>
Exact<D> exact_normal(const Simplex<D>& points) {
    const Exact<D> e = difference<D>(exact<D>(points[1]), exact<D>(points[0]));
    if constexpr (D == 2) {
        return {mpq_class(-e[1]), e[0]};
    } else {
        const Exact<3> f = difference<3>(exact<3>(points[2]), exact<3>(points[0]));
        return {mpq_class(e[1] * f[2] - e[2] * f[1]), mpq_class(e[2] * f[0] - e[0] * f[2]),
                mpq_class(e[0] * f[1] - e[1] * f[0])};
    }
}
/// |computed - exact| / error.
double part_of(double computed, const mpq_class& exact, double error) {
    if (!(error > 0.0) || !std::isfinite(computed) || !std::isfinite(error)) return -1.0;
    const mpq_class off = (mpq_class(computed) - exact) / mpq_class(error);
    return std::abs(off.get_d());
}

// ---- climbing

/// Input as a list of floats: points one after the other.
template <std::size_t N>
using Floats = std::array<float, N>;

template <int D, std::size_t N>
Point<D> point(const Floats<N>& numbers, std::size_t index) {
    Point<D> p;
    for (int axis = 0; axis < D; ++axis)
        p[axis] = numbers[index * D + static_cast<std::size_t>(axis)];
    return p;
}
template <int D, std::size_t N>
Simplex<D> simplex(const Floats<N>& numbers, std::size_t index) {
    if constexpr (D == 2)
        return {point<2>(numbers, index), point<2>(numbers, index + 1)};
    else
        return {point<3>(numbers, index), point<3>(numbers, index + 1),
                point<3>(numbers, index + 2)};
}

float some_float(Pcg32& random) {
    const float sign = random.below(2) ? 1.0f : -1.0f;
    const int exponent = static_cast<int>(random.below(12)) - 6;
    return sign * std::ldexp(random.uniform(1.0f, 2.0f), exponent);
}
/// Another float in place of one of the numbers: near it, like another of them, or any.
template <std::size_t N>
void change(Floats<N>& numbers, Pcg32& random) {
    float& x = numbers[random.below(N)];
    switch (random.below(6)) {
        case 0:
            x = some_float(random);
            break;
        case 1:
            x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) ^ (1u << random.below(24)));
            break;
        case 2:
            x = std::nextafter(x, random.below(2) ? infinity : -infinity);
            break;
        case 3:
            x = numbers[random.below(N)];
            break;
        case 4:
            x = numbers[random.below(N)];
            x = std::nextafter(x, random.below(2) ? infinity : -infinity);
            break;
        default:
            x = std::ldexp(x, static_cast<int>(random.below(5)) - 2);
            break;
    }
    if (!std::isfinite(x)) x = some_float(random);
}

/// The largest part of its bound that an error has been seen to be, and for which input.
template <std::size_t N>
struct Worst {
    double part = -1.0;
    Floats<N> numbers{};
};
/// From several random inputs on, changes that make the part larger, or leave it as it is, are
/// kept.
template <std::size_t N, class Part>
Worst<N> climb(std::uint64_t seed, const Part& part, int starts = 8) {
    Worst<N> worst;
    Pcg32 random(seed);
    for (int start = 0; start < starts; ++start) {
        Floats<N> numbers;
        for (float& x : numbers) x = some_float(random);
        double best = part(numbers);
        for (int i = 0; i < tries; ++i) {
            Floats<N> changed = numbers;
            for (std::uint32_t k = random.below(3); k < 3; ++k) change(changed, random);
            const double now = part(changed);
            if (now < best) continue;
            best = now;
            numbers = changed;
        }
        if (best > worst.part) worst = {best, numbers};
    }
    return worst;
}

template <std::size_t N>
void check(const char* name, const Worst<N>& worst, double floor) {
    fmt::print("  {}: the largest error is {:.3f} of its bound, at", name, worst.part);
    for (const float x : worst.numbers) fmt::print(" {:a}", x);
    fmt::print("\n");
    INFO(name);
    CHECK(worst.part < 1.0);
    CHECK(worst.part > floor);
}

// ---- the bounds

/// Of the height of a point over a plane, and of the slope of a vector along its normal.
template <int D, std::size_t N>
double part_of_height(const Floats<N>& numbers) {
    const Simplex<D> points = simplex<D>(numbers, 0);
    const SplitPlane<D> plane(points);
    const Point<D> p = point<D>(numbers, D);
    const Estimate height = along_normal(plane, Double<D>(p) - Double<D>(points[0]));
    const mpq_class truth =
        product<D>(exact_normal<D>(points), difference<D>(exact<D>(p), exact<D>(points[0])));
    return part_of(height.value, truth, height.error);
}
template <int D, std::size_t N>
double part_of_slope(const Floats<N>& numbers) {
    const Simplex<D> points = simplex<D>(numbers, 0);
    const Point<D> v = point<D>(numbers, D);
    const Estimate slope = along_normal(SplitPlane<D>(points), Double<D>(v));
    return part_of(slope.value, product<D>(exact_normal<D>(points), exact<D>(v)), slope.error);
}

/// Of the interval of t in which a ray crosses a plane, where it is one.
template <int D, std::size_t N>
double part_of_crossing(const Floats<N>& numbers) {
    const Simplex<D> points = simplex<D>(numbers, 0);
    const BasicRay<D> ray{point<D>(numbers, D), point<D>(numbers, D + 1)};
    if (!is_valid(ray)) return -1.0;
    const PlaneCrossing crossing = cross_plane(ray, SplitPlane<D>(points), 0.0, double{infinity});
    if (!std::isfinite(crossing.earliest) || !std::isfinite(crossing.latest)) return -1.0;
    const Exact<D> normal = exact_normal<D>(points);
    const mpq_class slope = product<D>(normal, exact<D>(ray.direction));
    if (slope == 0) return infinity;
    const mpq_class t =
        -product<D>(normal, difference<D>(exact<D>(ray.origin), exact<D>(points[0]))) / slope;
    const mpq_class middle = (mpq_class(crossing.earliest) + mpq_class(crossing.latest)) / 2;
    const mpq_class half = (mpq_class(crossing.latest) - mpq_class(crossing.earliest)) / 2;
    if (half <= 0) return t == middle ? 0.0 : double{infinity};
    return std::abs(mpq_class((t - middle) / half).get_d());
}

/// Of a corner where a polygon and two planes meet, and of one where an edge and a plane do.
double part_of_corner(const Meet<3>& meet) {
    const Approximation<3> at = approximate(meet);
    const std::array<mpq_class, 3> truth = exact_point(meet);
    double part = -1.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        part = std::max(part, part_of(at.at[static_cast<int>(axis)], truth[axis], at.error));
    return part;
}
bool meet_in_a_point(const Triangle& a, const Triangle& b, const Triangle& c) {
    const Exact<3> p = exact_normal<3>(a), q = exact_normal<3>(b), r = exact_normal<3>(c);
    return p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
               p[2] * (q[0] * r[1] - q[1] * r[0]) !=
           0;
}
double part_of_three_planes(const Floats<27>& numbers) {
    const Triangle polygon = simplex<3>(numbers, 0);
    const std::array planes{SplitPlane<3>(simplex<3>(numbers, 3)),
                            SplitPlane<3>(simplex<3>(numbers, 6))};
    if (!meet_in_a_point(polygon, planes[0].through, planes[1].through)) return -1.0;
    return part_of_corner({polygon, {Carrier::plane(0), Carrier::plane(1)}, planes});
}
double part_of_cut(const Floats<15>& numbers) {
    const Triangle polygon{point<3>(numbers, 0), point<3>(numbers, 1), {1, 2, 3}};
    const std::array planes{SplitPlane<3>(simplex<3>(numbers, 2))};
    const Exact<3> way = difference<3>(exact<3>(polygon.b), exact<3>(polygon.a));
    if (product<3>(exact_normal<3>(planes[0].through), way) == 0) return -1.0;
    return part_of_corner({polygon, {Carrier::original(0), Carrier::plane(0)}, planes});
}

/// The same where lines are so nearly parallel that double gives up and the exact point is rounded.
double part_of_rounding(const Floats<8>& numbers) {
    const Segment polygon = simplex<2>(numbers, 0);
    const auto nudged = [&](std::size_t index) {
        return Point2(point<2>(numbers, index) + 0x1p-23f * point<2>(numbers, index + 2));
    };
    const std::array lines{SplitPlane<2>({nudged(0), nudged(1)})};
    const Exact<2> way = difference<2>(exact<2>(polygon.b), exact<2>(polygon.a)),
                   normal = exact_normal<2>(lines[0].through);
    const mpq_class slope = product<2>(normal, way);
    if (slope == 0) return -1.0;
    const Approximation<2> at = approximate(Meet<2>{polygon, {Carrier::plane(0)}, lines});
    if (at.error > 7.0 * double_roundoff * std::max(std::abs(at.at.x), std::abs(at.at.y)))
        return -1.0;
    const mpq_class s =
        product<2>(normal, difference<2>(exact<2>(lines[0].through.a), exact<2>(polygon.a))) /
        slope;
    double part = -1.0;
    for (std::size_t axis = 0; axis < 2; ++axis)
        part = std::max(
            part, part_of(at.at[static_cast<int>(axis)],
                          mpq_class(polygon.a[static_cast<int>(axis)]) + s * way[axis], at.error));
    return part;
}

}  // namespace

TEST_CASE("heights over a plane and slopes along its normal are off by at most their errors") {
    // More than a quarter: with a quarter of the roundings the bound would be wrong.
    check("height over a plane", climb<12>(1, part_of_height<3, 12>), 0.25);
    check("slope along a plane's normal", climb<12>(1, part_of_slope<3, 12>), 0.25);
    // A line's normal has no products.
    check("height over a line", climb<6>(1, part_of_height<2, 6>), 0.1);
    check("slope along a line's normal", climb<6>(1, part_of_slope<2, 6>), 0.1);
}

TEST_CASE("a ray crosses a plane at a t within the interval that cross_plane gives") {
    check("crossing of a plane", climb<15>(1, part_of_crossing<3, 15>), 0.1);
    check("crossing of a line", climb<8>(1, part_of_crossing<2, 8>), 0.1);
}

TEST_CASE("a ray that computed slopes call nearly parallel crosses where it may, on a late t") {
    // z = 0, and rays that sink by 2^-60 for each unit of x: less than the slope's error.
    const SplitPlane<3> ground({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const Ray sinking{{0, 0, 0x1p-55f}, {1, 0, -0x1p-60f}};  // through the plane at t = 32
    const PlaneCrossing late = cross_plane(sinking, ground, 0.0, 1024.0);
    CHECK(late.earliest <= 32.0);
    CHECK(late.latest >= 32.0);
    CHECK(late.starts_in_front);
    const Ray rising{{0, 0, -0x1p-55f}, {1, 0, 0x1p-60f}};
    CHECK_FALSE(cross_plane(rising, ground, -1024.0, 0.0).starts_in_front);
    CHECK(cross_plane(rising, ground, -1024.0, 0.0).earliest == -infinity);
    // Far above it none crosses, in whatever of its two ways of saying so.
    const PlaneCrossing never = cross_plane<3>({{0, 0, 1}, {1, 0, -0x1p-60f}}, ground, 0.0, 1024.0);
    CHECK(never.earliest == infinity);
    CHECK(never.starts_in_front);
    CHECK(cross_plane<3>({{0, 0, -1}, {1, 0, 0}}, ground, -9.0, 9.0).earliest == infinity);
    CHECK_FALSE(cross_plane<3>({{0, 0, -1}, {1, 0, 0}}, ground, -9.0, 9.0).starts_in_front);
}

TEST_CASE("a ray in the plane is never said to stay clear of it, whatever roundings say") {
    Pcg32 random(7);
    int above = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto point = [&] {
            const float x = some_float(random), y = some_float(random), z = some_float(random);
            return Point3(x, y, z);
        };
        const Point3 b = point(), c = point();
        const SplitPlane<3> plane({{0, 0, 0}, b, c});
        above += plane.distance(Double3(c)) != 0.0;  // c is exactly in the plane, and b along it
        CHECK(cross_plane<3>({c, b}, plane, 0.0, 0.0).earliest != infinity);
    }
    CHECK(above > 100);
}

TEST_CASE("corners lie as near to their exact points as they say") {
    check("cut of an edge", climb<15>(1, part_of_cut), 0.4);
    check("meet of three planes", climb<27>(1, part_of_three_planes, 2), 0.3);
    check("rounded exact point", climb<8>(1, part_of_rounding), 0.4);
}

}  // namespace space
