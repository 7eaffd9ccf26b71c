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

constexpr int each = sized(800, 100);

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
float far_number(Pcg32& random) {
    return 1e5f + random.uniform(-1.0f, 1.0f);
}

/// The points that make(i) gives for i = 0 .. D - 1.
template <int D, class Make>
Simplex<D> simplex_of(const Make& make) {
    const Point<D> first = make(0), second = make(1);
    if constexpr (D == 2)
        return {first, second};
    else
        return {first, second, make(2)};
}
template <int D>
Simplex<D> random_simplex(Pcg32& random, const MakeFloat& number) {
    return simplex_of<D>([&](int) {
        Point<D> point;
        for (int axis = 0; axis < D; ++axis) point[axis] = number(random);
        return point;
    });
}

/// Every coordinate moved by up to two floats: planes that meet at tiny angles.
template <int D>
Simplex<D> nudged(const Simplex<D>& points, Pcg32& random) {
    return simplex_of<D>([&](int i) {
        Point<D> point = points[i];
        for (int axis = 0; axis < D; ++axis)
            for (std::uint32_t k = random.below(3); k > 0; --k)
                point[axis] = std::nextafter(point[axis], random.below(2) ? 2.0f : -2.0f);
        return point;
    });
}
/// Every coordinate moved by its 2^-1 to 2^-22nd: planes that meet at small angles of all sizes.
template <int D>
Simplex<D> moved(const Simplex<D>& points, Pcg32& random) {
    const float size = std::ldexp(1.0f, -1 - static_cast<int>(random.below(22)));
    return simplex_of<D>([&](int i) {
        Point<D> point = points[i];
        for (int axis = 0; axis < D; ++axis) point[axis] += size * random.uniform(-1.0f, 1.0f);
        return point;
    });
}
/// Through (nearly) the given point: its sides are decided in the last bits.
template <int D>
Simplex<D> through(const Double<D>& p, Pcg32& random, const MakeFloat& number) {
    const Simplex<D> points = random_simplex<D>(random, number);
    const Point<D> first(p);
    if (!is_finite<D>(first)) return random_simplex<D>(random, number);
    return simplex_of<D>([&](int i) { return i == 0 ? first : points[i]; });
}

struct Tally {
    std::uint64_t decisions = 0, on = 0, wrong = 0;  ///< sides, and those that differ from CGAL's
    std::uint64_t filtered = 0, wrong_filter = 0;    ///< decided by side_filter
    std::uint64_t meets = 0, beyond = 0;  ///< approximations, and those farther off than they say
};

template <int D>
void compare_side(const Simplex<D>& plane, const Meet<D>& meet, const Approximation<D>& at,
                  Tally& tally) {
    const int expected = cgal_side(plane, meet).value();
    ++tally.decisions;
    tally.on += expected == 0;
    tally.wrong += exact_side<D>(plane, meet) != expected;
    if (const auto side = side_filter(SplitPlane<D>(plane), at.at, at.error)) {
        ++tally.filtered;
        tally.wrong_filter += *side != expected;
    }
}

template <int D>
void compare_meet(const Meet<D>& meet, const std::vector<Simplex<D>>& planes, Pcg32& random,
                  const MakeFloat& number, Tally& tally) {
    if (!cgal_side(planes[0], meet)) return;  // parallel, or no planes at all
    const Approximation<D> at = approximate(meet);
    ++tally.meets;
    tally.beyond += !cgal_encloses(at, meet);
    for (const Simplex<D>& plane : planes) compare_side<D>(plane, meet, at, tally);
    compare_side<D>(through<D>(at.at, random, number), meet, at, tally);
}

/// Makes polygon, first plane and second plane, asks for all their meets and the sides of those.
enum class Angles { any, small, tiny };
Tally compare_all(int rounds, std::uint64_t seed, const MakeFloat& number, Angles angles) {
    Pcg32 random(seed);
    Tally tally;
    const auto plane_near = [&]<int D>(const Simplex<D>& other) {
        return angles == Angles::tiny    ? nudged<D>(other, random)
               : angles == Angles::small ? moved<D>(other, random)
                                         : random_simplex<D>(random, number);
    };
    for (int i = 0; i < rounds; ++i) {
        const Triangle polygon = random_simplex<3>(random, number),
                       p = plane_near.template operator()<3>(polygon),
                       q = plane_near.template operator()<3>(p),
                       other = plane_near.template operator()<3>(q);
        const std::vector<Triangle> planes{other, p, q, polygon};
        const int edge = static_cast<int>(random.below(3));
        const std::vector<SplitPlane<3>> carriers{SplitPlane<3>(p), SplitPlane<3>(q)};
        const Carrier own = Carrier::original(edge), next = Carrier::original((edge + 1) % 3),
                      first = Carrier::plane(0), second = Carrier::plane(1);
        for (const auto& pair :
             {std::array{own, first}, {first, own}, {first, second}, {own, next}})
            compare_meet(Meet<3>{polygon, pair, carriers}, planes, random, number, tally);

        const Segment segment = random_simplex<2>(random, number),
                      line = plane_near.template operator()<2>(segment),
                      third = plane_near.template operator()<2>(line);
        const std::vector<SplitPlane<2>> lines{SplitPlane<2>(line)};
        compare_meet(Meet<2>{segment, {first}, lines}, {third, line, segment}, random, number,
                     tally);

        for (const Triangle& plane : planes) {
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
        const int expected = cgal_side(third, Double2(segment[0]));
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
    check("small angles, far away", 13, far_number, Angles::small);
    check("tiny angles", 3, ordinary, Angles::tiny);
    check("tiny angles between whole numbers", 4, small_whole, Angles::tiny);
}
TEST_CASE("the same far from the origin") {
    check("far away", 5, far_number);
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

// ---- properties
// -------------------------------------------------------------------------------------------------

namespace {

rc::Gen<float> coordinate() {
    return rc::gen::map(rc::gen::inRange(-2048, 2048),
                        [](int i) { return static_cast<float>(i) * 0x1p-10f; });
}
Triangle some_plane() {
    return simplex_of<3>([](int) {
        Point3 point;
        for (int axis = 0; axis < 3; ++axis) point[axis] = *coordinate();
        return point;
    });
}

/// Where a polygon and two planes meet.
struct Three {
    Triangle polygon;
    std::vector<SplitPlane<3>> planes;

    Three(const Triangle& p, const Triangle& q, const Triangle& r)
        : polygon(p), planes{SplitPlane<3>(q), SplitPlane<3>(r)} {}
    Meet<3> meet() const { return {polygon, {Carrier::plane(0), Carrier::plane(1)}, planes}; }
};

}  // namespace

TEST_CASE("property: a plane with two corners exchanged has its sides exchanged") {
    CHECK(rc::check([] {
        const Triangle polygon = some_plane(), p = some_plane(), q = some_plane(),
                       plane = some_plane();
        const Three three(polygon, p, q);
        const Meet<3> meet = three.meet();
        RC_PRE(cgal_side(plane, meet).has_value());
        RC_ASSERT(exact_side<3>({plane.a, plane.c, plane.b}, meet) == -exact_side<3>(plane, meet));
    }));
}

TEST_CASE(
    "property: a corner lies on every plane that makes it, and the order of the planes doesn't "
    "matter") {
    CHECK(rc::check([] {
        const Triangle polygon = some_plane(), p = some_plane(), q = some_plane(),
                       plane = some_plane();
        const Three three(polygon, p, q), other(p, q, polygon);
        RC_PRE(cgal_side(plane, three.meet()).has_value());
        for (const Triangle& own : {polygon, p, q})
            RC_ASSERT(exact_side<3>(own, three.meet()) == 0);
        RC_ASSERT(exact_side<3>(plane, three.meet()) == exact_side<3>(plane, other.meet()));
    }));
}

TEST_CASE("property: both polygons of an edge round its cut to the same point, bit for bit") {
    CHECK(rc::check([] {
        const Triangle polygon = some_plane(), plane = some_plane();
        const Triangle neighbour{polygon[1], polygon[0],
                                 some_plane()[2]};  // its edge 0 runs the other way
        const std::vector<SplitPlane<3>> planes{SplitPlane<3>(plane)};
        const std::array carriers{Carrier::original(0), Carrier::plane(0)};
        const Meet<3> one{polygon, carriers, planes}, other{neighbour, carriers, planes};
        RC_PRE(cgal_side(plane, one).has_value());
        const Approximation<3> a = approximate(one), b = approximate(other);
        RC_ASSERT(a.at == b.at);
        RC_ASSERT(a.error == b.error);
    }));
}

}  // namespace space
