// How wide the chapter's error bounds are: the largest error, as a part of its bound, that a climb
// finds over adversarial input, held against exact rational numbers. A bound is sound while the
// part stays below 1, and no wider than need be while it stays above its floor.
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "chapters/ch03_bsp_trees/exact_point.hpp"
#include "chapters/ch03_bsp_trees/measured/known_errors.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/exact_vector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

namespace space {
namespace {

constexpr int starts = sized(6, 2), tries = sized(15'000, 400);

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

template <int D>
Point<D> point(std::span<const float> numbers, std::size_t index) {
    Point<D> p;
    for (int axis = 0; axis < D; ++axis)
        p[axis] = numbers[index * D + static_cast<std::size_t>(axis)];
    return p;
}
template <int D>
Simplex<D> simplex(std::span<const float> numbers, std::size_t index) {
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

/// From several random inputs on, changes that make the part larger, or leave it as it is, are
/// kept.
template <std::size_t N, class Part>
double climb(const Part& part) {
    double worst = -1.0;
    for (std::uint64_t start = 0; start < starts; ++start) {
        Pcg32 random(1, start);
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
        worst = std::max(worst, best);
    }
    return worst;
}

/// No error exceeds its bound, on climbs from random inputs; and the worst input that much longer
/// climbs found once comes to `floor` of it. How far these short climbs come is their luck.
template <std::size_t N, class Part>
void check(const char* name, const Part& part, const Floats<N>& worst, double floor) {
    const double known = part(worst), climbed = climb<N>(part);
    fmt::print("  {}: the largest error is {:.3f} of its bound, climbed {:.3f}\n", name, known,
               climbed);
    INFO(name << ": " << known << ", climbed " << climbed);
    CHECK(std::max(known, climbed) < 1.0);
    CHECK(known > floor);
    CHECK(climbed > 0.0);
}

// ---- the bounds

/// Of the height of a point over a plane, and of the slope of a vector along its normal.
template <int D, std::size_t N>
double part_of_height(const Floats<N>& numbers) {
    const Simplex<D> points = simplex<D>(numbers, 0);
    const SplitPlane<D> plane(points);
    const Point<D> p = point<D>(numbers, D);
    const Estimate height = along_normal(plane, Double<D>(p) - Double<D>(points[0]));
    const mpq_class truth = dot(exact_normal(points), exact(p) - exact(points[0]));
    return part_of(height.value, truth, height.error);
}
template <int D, std::size_t N>
double part_of_slope(const Floats<N>& numbers) {
    const Simplex<D> points = simplex<D>(numbers, 0);
    const Point<D> v = point<D>(numbers, D);
    const Estimate slope = along_normal(SplitPlane<D>(points), Double<D>(v));
    return part_of(slope.value, dot(exact_normal(points), exact(v)), slope.error);
}

/// Of the interval of t in which a ray crosses a plane, where it is one.
template <int D, std::size_t N>
double part_of_crossing(const Floats<N>& numbers) {
    const Simplex<D> points = simplex<D>(numbers, 0);
    const BasicRay<D> ray{point<D>(numbers, D), point<D>(numbers, D + 1)};
    if (!is_valid(ray)) return -1.0;
    const PlaneCrossing crossing = cross_plane(ray, SplitPlane<D>(points), 0.0, double{infinity});
    if (!std::isfinite(crossing.earliest) || !std::isfinite(crossing.latest)) return -1.0;
    const ExactVector<D> normal = exact_normal(points);
    const mpq_class slope = dot(normal, exact(ray.direction));
    if (slope == 0) return infinity;
    const mpq_class t = -dot(normal, exact(ray.origin) - exact(points[0])) / slope;
    const mpq_class middle = (mpq_class(crossing.earliest) + mpq_class(crossing.latest)) / 2;
    const mpq_class half = (mpq_class(crossing.latest) - mpq_class(crossing.earliest)) / 2;
    if (half <= 0) return t == middle ? 0.0 : double{infinity};
    return std::abs(mpq_class((t - middle) / half).get_d());
}

/// Whether double gave up and the exact point was rounded: the error is four half places, and more
/// than ten where double answers.
template <int D>
bool is_rounded(const Approximation<D>& point) {
    double largest = 0.0;
    for (int axis = 0; axis < D; ++axis) largest = std::max(largest, std::abs(point.at[axis]));
    return point.error <= 7.0 * double_roundoff * largest;
}

double part_of_point(const Approximation<3>& at, const std::array<mpq_class, 3>& truth) {
    double part = -1.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        part = std::max(part, part_of(at.at[static_cast<int>(axis)], truth[axis], at.error));
    return part;
}
/// Of a corner where a polygon and two planes meet, and of one where an edge and a plane do, where
/// double answers.
double part_of_corner(const Meet<3>& meet) {
    const Approximation<3> at = approximate(meet);
    return is_rounded(at) ? -1.0 : part_of_point(at, exact_point(meet));
}
bool meet_in_a_point(const Triangle& a, const Triangle& b, const Triangle& c) {
    return dot(exact_normal(a), cross(exact_normal(b), exact_normal(c))) != 0;
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
    const ExactVector<3> way = exact(polygon.b) - exact(polygon.a);
    if (dot(exact_normal(planes[0].through), way) == 0) return -1.0;
    return part_of_corner({polygon, {Carrier::original(0), Carrier::plane(0)}, planes});
}

/// The same where lines are so nearly parallel that double gives up and the exact point is rounded.
double part_of_rounding(const Floats<8>& numbers) {
    const Segment polygon = simplex<2>(numbers, 0);
    const auto nudged = [&](std::size_t index) {
        return Point2(point<2>(numbers, index) + 0x1p-23f * point<2>(numbers, index + 2));
    };
    const std::array lines{SplitPlane<2>({nudged(0), nudged(1)})};
    const ExactVector<2> way = exact(polygon.b) - exact(polygon.a),
                         normal = exact_normal(lines[0].through);
    const mpq_class slope = dot(normal, way);
    if (slope == 0) return -1.0;
    const Approximation<2> at = approximate(Meet<2>{polygon, {Carrier::plane(0)}, lines});
    if (!is_rounded(at)) return -1.0;
    const mpq_class s = dot(normal, exact(lines[0].through.a) - exact(polygon.a)) / slope;
    double part = -1.0;
    for (int axis = 0; axis < 2; ++axis)
        part = std::max(part,
                        part_of(at.at[axis], mpq_class(polygon.a[axis]) + s * way[axis], at.error));
    return part;
}

}  // namespace

TEST_CASE("heights over a plane and slopes along its normal are off by at most their errors") {
    // More than a quarter: with a quarter of the roundings the bound would be wrong.
    check<12>("height over a plane", part_of_height<3, 12>, ch03::worst_height, 0.3);
    check<12>("slope along a plane's normal", part_of_slope<3, 12>, ch03::worst_slope, 0.29);
    // What the text tells.
    CHECK(ch03::worst_known_share() == Approx(std::max(part_of_height<3, 12>(ch03::worst_height),
                                                       part_of_slope<3, 12>(ch03::worst_slope))));
    // A line's normal has no products.
    check<6>("height over a line", part_of_height<2, 6>,
             {0x1.fdf7e8p+1f, -0x1.3ffdfcp+3f, 0x1.fdf7e6p+1f, -0x1.30df62p+5f, -0x1.217108p+9f,
              -0x1.3ffe0cp+3f},
             0.124);
    check<6>("slope along a line's normal", part_of_slope<2, 6>,
             {0x1.485d92p+4f, 0x1.161fa4p+5f, -0x1.800282p-2f, 0x1.161fa2p+5f, -0x1.01p-9f,
              0x1.880082p+13f},
             0.124);
}

TEST_CASE("a ray crosses a plane at a t within the interval that cross_plane gives") {
    check<15>("crossing of a plane", part_of_crossing<3, 15>,
              {0x1.85e18cp+5f, -0x1.33c6dap+0f, 0x1.d29344p+4f, 0x1.85e18cp+5f, 0x1.d23d38p-3f,
               -0x1.d9dc8cp+5f, -0x1.d9d48ep+5f, -0x1.99764ep-1f, 0x1.d29346p+4f, 0x1.785d7p+3f,
               -0x1.dddc94p+9f, 0x1.00fd6ep-4f, -0x1.bf42p+5f, -0x1.d9dc92p+9f, 0x1.f1d614p-4f},
              0.18);
    check<8>("crossing of a line", part_of_crossing<2, 8>,
             {-0x1.9ee91cp-2f, 0x1.975faep+5f, -0x1.ab4d8cp+5f, 0x1.97dfbp+5f, 0x1.42e6p-5f,
              0x1.78947p+3f, 0x1.92f042p-9f, 0x1.35c016p+2f},
             0.15);
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
    // As steep as computed slopes may be without being believed: through the plane at t = 877.
    const Ray steeper{{0, 0, 0x1.8p-39f}, {1, 0, -0x1.cp-49f}};
    CHECK(cross_plane(steeper, ground, 0.0, 1024.0).earliest <= 877.0);
    // Far above it none crosses, in whatever of its two ways of saying so.
    const PlaneCrossing never = cross_plane<3>({{0, 0, 1}, {1, 0, -0x1p-60f}}, ground, 0.0, 1024.0);
    CHECK(never.earliest == infinity);
    CHECK(never.starts_in_front);
    CHECK(cross_plane<3>({{0, 0, -1}, {1, 0, 0}}, ground, -9.0, 9.0).earliest == infinity);
    CHECK_FALSE(cross_plane<3>({{0, 0, -1}, {1, 0, 0}}, ground, -9.0, 9.0).starts_in_front);
}

TEST_CASE("a ray in the plane may meet it anywhere on its way, whatever roundings say") {
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
        CHECK(!side_filter(plane, Double3(c), 0.0));
        for (const double leave : {0.0, 1024.0}) {
            const PlaneCrossing crossing = cross_plane<3>({c, b}, plane, 0.0, leave);
            CHECK(crossing.earliest <= 0.0);
            CHECK(crossing.latest >= leave);
        }
    }
    CHECK(above > 100);
}

TEST_CASE(
    "the filter takes no point for one beyond the plane that its error may have brought there") {
    const SplitPlane<3> ground({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    for (const double off : {0x1p-40, 0x1p-10, 1.0})
        for (const double side : {-1.0, 1.0}) {
            const auto filtered = [&](double height) {
                return side_filter(ground, Double3(3, -5, side * height), off);
            };
            CHECK(!filtered(0.999 * off));  // the point itself may be a thousandth beyond
            CHECK(filtered(2.1 * off) == static_cast<int>(side));
        }
}

TEST_CASE(
    "a ray that is level only for computed slopes meets the plane where its exact slope says") {
    Pcg32 random(8);
    int level = 0;
    for (int i = 0; i < 1000; ++i) {
        // Two corners of one height, and a first one whose last bits their differences lose.
        const auto number = [&] { return 0x1p-12f * static_cast<float>(random.below(1u << 16)); };
        const float ax = 0x1p-36f * number(), ay = 0x1p-36f * number(), bx = number(),
                    by = number(), cx = number(), cy = number(), z = some_float(random);
        const Triangle through{{ax, ay, 0}, {bx, by, z}, {cx, cy, z}};
        const SplitPlane<3> plane(through);
        // Along their edge but for what its computed slope is wrong by, and so high that t is 512.
        const Vector3 along = through.b - through.c;
        const double noise = along_normal(plane, Double3(along)).value / plane.normal.z;
        const Ray ray{{ax, ay, 512.0 * noise}, {along.x, along.y, -noise}};
        const ExactVector<3> normal = exact_normal(through);
        const mpq_class slope = dot(normal, exact(ray.direction));
        if (slope == 0) continue;
        const double computed = along_normal(plane, Double3(ray.direction)).value;
        level += std::abs(computed) < 1e-6 * std::abs(slope.get_d());
        const mpq_class t = -dot(normal, exact(ray.origin)) / slope;
        const PlaneCrossing crossing = cross_plane(ray, plane, 0.0, 1024.0);
        REQUIRE(crossing.earliest < infinity);
        CHECK((crossing.earliest == -infinity || crossing.earliest <= t));
        CHECK((crossing.latest == infinity || crossing.latest >= t));
    }
    CHECK(level > 100);
}

TEST_CASE("corners lie as near to their exact points as they say") {
    check<15>("cut of an edge", part_of_cut,
              {0x1.025374p+3f, -0x1.7c52fcp-6f, -0x1.fcc82ap+3f, 0x1.02516cp+3f, -0x1.f8ffa4p-7f,
               -0x1.ef5af8p+3f, -0x1.f7a618p+0f, -0x1.d36cfp-3f, -0x1.fb0876p+3f, -0x1.f7a716p+0f,
               -0x1.b3a938p+3f, -0x1.fcc826p+3f, -0x1.f8ffbp-6f, -0x1.f8ffeep-8f, -0x1.f8ffeep-6f},
              0.14);
    check<27>(
        "meet of three planes", part_of_three_planes,
        {-0x1.6f8f46p+2f,  -0x1.962f0ap-32f, 0x1.de1d2ap-3f,   -0x1.9a5578p+2f, 0x1.642232p-3f,
         0x1.8168b4p+5f,   0x1.e5dbb8p+6f,   -0x1.43e92ep-41f, -0x1.7634dp-30f, -0x1p-51f,
         -0x1.2db394p-28f, 0x1.e57fb8p-32f,  -0x1.a7ed08p-8f,  0x1.f7d766p+1f,  0x1.dd2452p-23f,
         0x1.6dfef8p-20f,  0x1.6dfff6p-20f,  -0x1.a0b568p+0f,  0x1p-51f,        -0x1.2d9f4p-29f,
         0x1.e3ffacp-3f,   -0x1.32124ap-3f,  0x1.df0354p-23f,  0x1.f3d766p+1f,  0x1.80f08p-42f,
         0x1.c00a8ap+5f,   0x1.117f76p-28f},
        0.13);
    check<8>("rounded exact point", part_of_rounding,
             {0x1.b975f4p-4f, 0x1.2b2946p+4f, 0x1.2b3b48p+6f, -0x1.f4c54cp-5f, -0x1.f4c54ap-5f,
              0x1.c3034ap+0f, 0x1.99f4fap-4f, 0x1.99f4f8p-4f},
             0.73);
}

TEST_CASE(
    "double knows the cut of an edge while lines aren't too nearly parallel, to 2^-29 of it") {
    const Segment edge{{0, 0}, {1, 0}};
    for (int k = 0; k <= 60; ++k) {  // a line that rises by 2^-k along the edge
        const float rise = std::ldexp(1.0f, -k);
        const std::array lines{SplitPlane<2>({{0, -0.375f * rise}, {1, 0.625f * rise}})};
        const Approximation<2> at = approximate(Meet<2>{edge, {Carrier::plane(0)}, lines});
        INFO("2^-" << k);
        CHECK(std::abs(at.at.x - 0.375) <= at.error);
        CHECK(at.error < 0x1p-29);
        CHECK((k > 15 || !is_rounded(at)));
        CHECK((k < 25 || is_rounded(at)));
    }
}

TEST_CASE("double knows where three planes meet while they aren't too nearly parallel, to 2^-27") {
    const Triangle ground{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (int k = 0; k <= 60; ++k) {  // a plane that rises by 2^-k along x, and one across y
        const float rise = std::ldexp(1.0f, -k);
        const std::array planes{
            SplitPlane<3>({{0, 0, -0.375f * rise}, {1, 0, 0.625f * rise}, {0, 1, -0.375f * rise}}),
            SplitPlane<3>({{0, 0.25f, 0}, {0, 0.25f, 1}, {1, 0.25f, 0}})};
        const Approximation<3> at =
            approximate(Meet<3>{ground, {Carrier::plane(0), Carrier::plane(1)}, planes});
        INFO("2^-" << k);
        CHECK(std::abs(at.at.x - 0.375) <= at.error);
        CHECK(at.error < 0x1p-27);
        CHECK((k > 12 || !is_rounded(at)));
        CHECK((k < 25 || is_rounded(at)));
    }
}

TEST_CASE("an edge is cut where it is, though double puts its far end behind the plane") {
    Pcg32 random(9);
    int turned = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto number = [&] { return some_float(random); };
        const float ax = 0x1p-36f * number(), ay = 0x1p-36f * number(), bx = std::abs(number()),
                    by = number(), cx = number(), cy = number();
        // The differences lose the first corner's last bits.
        const SplitPlane<3> plane({{ax, ay, 0}, {bx, by, 0}, {cx, cy, number()}});
        // b is in the plane, and computed `noise` above it. The edge begins 2^-40 of that above the
        // plane, and ends 2^-10 of it below.
        const double noise = plane.distance({bx, by, 0}) / plane.normal.z;
        if (noise == 0.0) continue;
        const Triangle polygon{{ax, ay, 0x1p-40 * noise}, {bx, by, -0x1p-10 * noise}, {0, 9, 9}};
        turned += plane.distance(Double3(polygon.b)) / plane.normal.z * noise > 0.0;
        const std::array planes{plane};
        const Meet<3> meet{polygon, {Carrier::original(0), Carrier::plane(0)}, planes};
        CHECK(part_of_point(approximate(meet), exact_point(meet)) < 1.0);
    }
    CHECK(turned > 100);
}

namespace {

/// Through points of size 1 or 2.
Triangle some_triangle(Pcg32& random) {
    const auto point = [&] {
        const float x = random.uniform(1.0f, 2.0f), y = random.uniform(1.0f, 2.0f);
        return Point3(x, y, random.uniform(1.0f, 2.0f));
    };
    const Point3 a = point(), b = point();
    return {a, b, point()};
}
/// Far from the points that make the plane.
Triangle nearly_through_the_origin(Pcg32& random) {
    const auto [a, b, c] = some_triangle(random);
    return {a, b, -0.7f * a - 0.4f * b};
}
Triangle through_the_origin(Pcg32& random) {
    const auto [a, b, c] = some_triangle(random);
    return {{0, 0, 0}, b, c};
}

}  // namespace

TEST_CASE("an edge that begins beside a plane is cut as near as its height there is known") {
    Pcg32 random(11);
    for (int i = 0; i < 1000; ++i) {
        const std::array planes{SplitPlane<3>(nearly_through_the_origin(random))};
        const Point3 along(planes[0].normal / planes[0].length);
        const Triangle polygon{{0, 0, 0}, along.x > 0.0f ? along : -along, {1, 2, 3}};
        const Meet<3> meet{polygon, {Carrier::original(0), Carrier::plane(0)}, planes};
        CHECK(part_of_point(approximate(meet), exact_point(meet)) < 1.0);
    }
}

TEST_CASE("a corner beside its polygon's first one is as near as planes of far points are known") {
    Pcg32 random(12);
    for (int i = 0; i < 1000; ++i) {
        const Triangle polygon = through_the_origin(random), other = through_the_origin(random);
        const std::array planes{SplitPlane<3>(other),
                                SplitPlane<3>(nearly_through_the_origin(random))};
        for (const std::uint32_t first : {0u, 1u}) {
            const std::array carriers{Carrier::plane(first), Carrier::plane(1 - first)};
            const Meet<3> meet{polygon, carriers, planes};
            CHECK(part_of_point(approximate(meet), exact_point(meet)) < 1.0);
        }
    }
}

TEST_CASE("far from the origin a corner's own rounding is in its error") {
    Pcg32 random(10);
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
        Floats<27> numbers;
        for (float& x : numbers) x = 0x1p20f + 0.125f * static_cast<float>(random.below(64));
        const Triangle polygon = simplex<3>(numbers, 0);
        const std::array planes{SplitPlane<3>(simplex<3>(numbers, 3)),
                                SplitPlane<3>(simplex<3>(numbers, 6))};
        if (!meet_in_a_point(polygon, planes[0].through, planes[1].through)) continue;
        for (const Carrier first : {Carrier::original(0), Carrier::plane(1)}) {
            const Meet<3> meet{polygon, {first, Carrier::plane(0)}, planes};
            worst = std::max(worst, part_of_point(approximate(meet), exact_point(meet)));
        }
    }
    fmt::print("  corners, far away: the largest error is {:.3f} of its bound\n", worst);
    CHECK(worst < 1.0);
    CHECK(worst > 0.0);
}

}  // namespace space
