// Sides and coordinates of exact corners against CGAL's rational numbers.
#include "chapters/ch03_bsp_trees/exact_corner.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/ch03/cgal_fragments.hpp"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <bit>
#include <cstdlib>
#include <functional>

namespace space {
namespace {

#ifdef BOOK_SANITIZED
constexpr int each = 100;
#else
constexpr int each = 2'000;
#endif

/// The same examples on every run; RC_PARAMS in the environment asks for others.
const int seeded = ::setenv("RC_PARAMS", "seed=1 max_success=1000", 0);

// ---- numbers and planes on which predicates fail
// ------------------------------------------------------------------

using MakeFloat = std::function<float(Pcg32&)>;

float ordinary(Pcg32& random) {
    return random.uniform(-1.0f, 1.0f);
}
/// Points on planes, edges in planes, planes that are the same: coincidences abound.
float small_whole(Pcg32& random) {
    return static_cast<float>(random.below(7)) - 3.0f;
}
float huge(Pcg32& random) {
    return random.uniform(-1.0f, 1.0f) * std::numeric_limits<float>::max();
}
float tiny(Pcg32& random) {
    return random.uniform(-1.0f, 1.0f) * 0x1p-120f;
}
float denormal(Pcg32& random) {
    return std::ldexp(static_cast<float>(random.below(2001)) - 1000.0f, -149);
}
float smallest(Pcg32& random) {
    return std::ldexp(small_whole(random), -149);
}
/// Any finite float: the bits are drawn.
float wild(Pcg32& random) {
    for (;;)
        if (const auto x = std::bit_cast<float>(random.next()); std::isfinite(x)) return x;
}
/// Far from the origin: few bits are left for the polygons themselves.
float far_away(Pcg32& random) {
    return 1e5f + random.uniform(-1.0f, 1.0f);
}

template <int D>
Corners<D> corners_of(Pcg32& random, const MakeFloat& number) {
    Corners<D> points;
    for (auto& point : points)
        for (int axis = 0; axis < D; ++axis) point[axis] = number(random);
    return points;
}

/// Every coordinate moved by up to two floats: planes that meet at tiny angles.
template <int D>
Corners<D> nudged(Corners<D> points, Pcg32& random) {
    for (auto& point : points)
        for (int axis = 0; axis < D; ++axis)
            for (std::uint32_t i = random.below(3); i > 0; --i)
                point[axis] = std::nextafter(point[axis], random.below(2) ? 2.0f : -2.0f);
    return points;
}
/// Every coordinate moved by its 2^-1 to 2^-22nd: planes that meet at small angles of all sizes.
template <int D>
Corners<D> moved(Corners<D> points, Pcg32& random) {
    const float size = std::ldexp(1.0f, -1 - static_cast<int>(random.below(22)));
    for (auto& point : points)
        for (int axis = 0; axis < D; ++axis) point[axis] += size * random.uniform(-1.0f, 1.0f);
    return points;
}
/// Through (nearly) the given point: its sides are decided in the last bits.
template <int D>
Corners<D> through(const DoublePoint<D>& p, Pcg32& random, const MakeFloat& number) {
    Corners<D> points = corners_of<D>(random, number);
    points[0] = Point<D>(p);
    if (is_finite<D>(points[0])) return points;
    return corners_of<D>(random, number);
}

struct Tally {
    std::uint64_t decisions = 0, on = 0, wrong = 0;  ///< sides, and those that differ from CGAL's
    std::uint64_t filtered = 0, wrong_filter = 0;    ///< decided by side_filter
    std::uint64_t meets = 0, beyond = 0;  ///< approximations, and those farther off than they say
};

template <int D, class M>
void compare_side(const Corners<D>& plane, const M& meet, const Approximation<D>& at,
                  Tally& tally) {
    const int expected = cgal_side(plane, meet).value();
    ++tally.decisions;
    tally.on += expected == 0;
    tally.wrong += exact_side(plane, meet) != expected;
    if (const auto side = side_filter(SplitPlane<D>(plane), at.at, at.error)) {
        ++tally.filtered;
        tally.wrong_filter += *side != expected;
    }
}

template <int D, class M>
void compare_meet(const M& meet, const std::vector<Corners<D>>& planes, Pcg32& random,
                  const MakeFloat& number, Tally& tally) {
    if (!cgal_side(planes[0], meet)) return;  // parallel, or no planes at all
    const Approximation<D> at = approximate(meet);
    ++tally.meets;
    tally.beyond += !cgal_encloses(at, meet);
    for (const Corners<D>& plane : planes) compare_side<D>(plane, meet, at, tally);
    compare_side<D>(through<D>(at.at, random, number), meet, at, tally);
}

/// Makes polygon, first plane and second plane, asks for all their meets and the sides of those.
enum class Angles { any, small, tiny };
Tally compare_all(int rounds, std::uint64_t seed, const MakeFloat& number, Angles angles) {
    Pcg32 random(seed);
    Tally tally;
    const auto plane_near = [&]<int D>(const Corners<D>& other) {
        return angles == Angles::tiny    ? nudged<D>(other, random)
               : angles == Angles::small ? moved<D>(other, random)
                                         : corners_of<D>(random, number);
    };
    for (int i = 0; i < rounds; ++i) {
        const Corners<3> polygon = corners_of<3>(random, number),
                         p = plane_near.template operator()<3>(polygon),
                         q = plane_near.template operator()<3>(p),
                         other = plane_near.template operator()<3>(q);
        const std::vector<Corners<3>> planes{other, p, q, polygon};
        const int edge = static_cast<int>(random.below(3));
        for (const Meet3& meet :
             {Meet3{&polygon, edge, -1, nullptr, &p}, Meet3{&polygon, -1, edge, &p, nullptr},
              Meet3{&polygon, -1, -1, &p, &q},
              Meet3{&polygon, edge, (edge + 1) % 3, nullptr, nullptr}})
            compare_meet<3>(meet, planes, random, number, tally);

        const Corners<2> segment = corners_of<2>(random, number),
                         line = plane_near.template operator()<2>(segment),
                         third = plane_near.template operator()<2>(line);
        compare_meet<2>(Meet2{&segment, &line}, {third, line, segment}, random, number, tally);

        for (const Corners<3>& plane : planes) {
            const Point3 point = random.below(2) ? other[random.below(3)] : q[random.below(3)];
            const int expected = cgal_side(plane, Double3(point));
            ++tally.decisions;
            tally.on += expected == 0;
            tally.wrong += exact_side<3>(plane, point) != expected;
            if (const auto side = side_filter(SplitPlane<3>(plane), Double3(point), 0.0)) {
                ++tally.filtered;
                tally.wrong_filter += *side != expected;
            }
        }
        const int expected = cgal_side(third, DoublePoint<2>(segment[0]));
        tally.wrong += exact_side<2>(third, segment[0]) != expected;
    }
    return tally;
}

void check(const char* name, std::uint64_t seed, const MakeFloat& number,
           Angles angles = Angles::any) {
    const Tally tally = compare_all(each, seed, number, angles);
    fmt::print(
        "  {}: {} sides, {} of them on, of the others the filter decides {:.2f} %; {} meets\n",
        name, tally.decisions, tally.on,
        100.0 * static_cast<double>(tally.filtered) /
            static_cast<double>(tally.decisions - tally.on),
        tally.meets);
    CHECK(tally.wrong == 0);
    CHECK(tally.wrong_filter == 0);
    CHECK(tally.beyond == 0);
    CHECK(tally.meets >= static_cast<std::uint64_t>(each));
}

}  // namespace

TEST_CASE(
    "sides of corners of random planes are CGAL's, no filter errs, and every corner is within its "
    "error") {
    check("ordinary", 1, ordinary);
}
TEST_CASE("the same for whole numbers, where corners lie on planes and planes coincide") {
    check("whole numbers", 2, small_whole);
}
TEST_CASE("the same for planes that meet at small and tiny angles") {
    check("small angles", 12, ordinary, Angles::small);
    check("small angles, far away", 13, far_away, Angles::small);
    check("tiny angles", 3, ordinary, Angles::tiny);
    check("tiny angles between whole numbers", 4, small_whole, Angles::tiny);
}
TEST_CASE("the same far from the origin") {
    check("far away", 5, far_away);
}
TEST_CASE("the same for huge numbers") {
    check("huge", 6, huge);
}
TEST_CASE("the same for tiny numbers") {
    check("tiny", 7, tiny);
}
TEST_CASE("the same for denormal numbers") {
    check("denormal", 8, denormal);
    check("the smallest", 11, smallest);
}
TEST_CASE("the same for floats of all exponents") {
    check("wild", 9, wild);
}

TEST_CASE("the filter leaves less than one side in a thousand of random corners to exact numbers") {
    const Tally tally = compare_all(each, 10, ordinary, Angles::any);
    // Of the sides asked: a plane through the point rounded to float is far from it for doubles;
    // the planes that the meet lies on can't be filtered.
    CHECK(static_cast<double>(tally.filtered + tally.on) >
          0.999 * static_cast<double>(tally.decisions));
}

TEST_CASE("three points on a line in double that are none in exact arithmetic are told apart") {
    const float n = 0x1p23f, e = 0x1p-29f;
    const Corners<3> thin{{{e, 0, 0}, {n + 1, n, 0}, {-n - 1, -n, 0}}},
        line{{{0, 0, 0}, {n + 1, n, 0}, {-n - 1, -n, 0}}};
    CHECK_FALSE(is_on_a_line(thin));
    CHECK(is_on_a_line(line));
    CHECK(cgal_side(thin, Double3(0, 0, 1)) != 0);
    CHECK(cgal_side(line, Double3(0, 0, 1)) == 0);
}

// ---- properties
// -------------------------------------------------------------------------------------------------

namespace {

rc::Gen<float> coordinate() {
    return rc::gen::map(rc::gen::inRange(-2048, 2048),
                        [](int i) { return static_cast<float>(i) * 0x1p-10f; });
}
Corners<3> some_plane() {
    Corners<3> points;
    for (Point3& point : points)
        for (int axis = 0; axis < 3; ++axis) point[axis] = *coordinate();
    return points;
}

}  // namespace

TEST_CASE("property: a plane with two corners exchanged has its sides exchanged") {
    CHECK(rc::check([] {
        const Corners<3> polygon = some_plane(), p = some_plane(), q = some_plane(),
                         plane = some_plane();
        const Meet3 meet{&polygon, -1, -1, &p, &q};
        RC_PRE(cgal_side(plane, meet).has_value());
        RC_ASSERT(exact_side({plane[0], plane[2], plane[1]}, meet) == -exact_side(plane, meet));
    }));
}

TEST_CASE(
    "property: a corner lies on every plane that makes it, and the order of the planes doesn't "
    "matter") {
    CHECK(rc::check([] {
        const Corners<3> polygon = some_plane(), p = some_plane(), q = some_plane(),
                         plane = some_plane();
        const Meet3 meet{&polygon, -1, -1, &p, &q}, other{&p, -1, -1, &q, &polygon};
        RC_PRE(cgal_side(plane, meet).has_value());
        for (const Corners<3>& own : {polygon, p, q}) RC_ASSERT(exact_side(own, meet) == 0);
        RC_ASSERT(exact_side(plane, meet) == exact_side(plane, other));
    }));
}

TEST_CASE("property: both polygons of an edge round its cut to the same point, bit for bit") {
    CHECK(rc::check([] {
        const Corners<3> polygon = some_plane(), plane = some_plane();
        const Corners<3> neighbour{polygon[1], polygon[0],
                                   some_plane()[2]};  // its edge 0 runs the other way
        const Meet3 one{&polygon, 0, -1, nullptr, &plane},
            other{&neighbour, 0, -1, nullptr, &plane};
        RC_PRE(cgal_side(plane, one).has_value());
        const Approximation<3> a = approximate(one), b = approximate(other);
        RC_ASSERT(a.at == b.at);
        RC_ASSERT(a.error == b.error);
    }));
}

TEST_CASE("property: exactly the points on a line have no plane") {
    CHECK(rc::check([] {
        const Corners<3> p = some_plane();
        const auto steps = *rc::gen::inRange(-3, 4);
        const Corners<3> line{p[0], p[1],
                              p[0] + static_cast<float>(steps) * (p[1] - p[0])};  // sums are exact
        RC_ASSERT(is_on_a_line(line));
        Corners<3> bent = line;
        bent[2].x = std::nextafter(bent[2].x, infinity);
        RC_ASSERT(is_on_a_line(bent) == (cgal_side(bent, Double3(0, 0, 0)) == 0 &&
                                         cgal_side(bent, Double3(1, 0, 0)) == 0 &&
                                         cgal_side(bent, Double3(0, 1, 0)) == 0 &&
                                         cgal_side(bent, Double3(0, 0, 1)) == 0));
    }));
}

}  // namespace space
