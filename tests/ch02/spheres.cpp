#include "chapters/ch02_intersection_tests/spheres.hpp"

#include "chapters/ch02_intersection_tests/accuracy.hpp"
#include "chapters/ch02_intersection_tests/planes.hpp"
#include "tests/catch.hpp"

namespace space {
namespace {

#ifdef BOOK_SANITIZED
constexpr std::uint64_t rays = 500;
#else
constexpr std::uint64_t rays = 20'000;
#endif
constexpr std::size_t schoolbook = 1, stable = 2, in_double = 3;

}  // namespace

TEST_CASE("the printed sphere test hits spheres behind the origin, as many as before it; the others hit none of them") {
    const SpheresBehind found = spheres_behind(rays, 701);
    CHECK(found.exact_hits > 0);
    CHECK(found.behind > found.exact_hits / 2);
    CHECK(found.printed_hits == found.exact_hits + found.behind);
    const Sphere unit;
    const Ray away{{0, 0, 3}, {0, 0, 1}};
    CHECK(SphereAsPrinted::hits(away, unit));
    CHECK_FALSE(SphereSchoolbook::intersect(away, unit));
    CHECK_FALSE(SphereStable::intersect(away, unit));
    CHECK_FALSE(SphereDouble::intersect(away, unit));
}

TEST_CASE("from 3000 radii away the schoolbook's t is off by half a radius, the stable one's by the rounding of t") {
    const Ray ray{{0.9f, 0, 3000}, {0, 0, -1}};
    const double exact = 2999.56411;  // 3000 - sqrt(1 - 0.9f^2)
    CHECK(std::abs(SphereSchoolbook::intersect(ray, {}).value() - exact) > 0.25);
    CHECK(std::abs(SphereStable::intersect(ray, {}).value() - exact) < 0.0005);
    CHECK(std::abs(SphereDouble::intersect(ray, {}).value() - exact) < 0.00025);
}

TEST_CASE(
    "far away the stable test decides wrongly a thousandth as often as the schoolbook's, and in double never or "
    "nearly") {
    for (const double distance : {300.0, 3e3, 3e4}) {
        const SphereAccuracy found = sphere_accuracy(distance, rays, 702, 2);
        const auto wrong = [&](std::size_t test) { return found.wrong[test].hits + found.wrong[test].misses; };
        INFO(distance << " radii: schoolbook " << wrong(schoolbook) << ", stable " << wrong(stable) << ", double "
                      << wrong(in_double));
        CHECK(wrong(schoolbook) > rays / 500);
        CHECK(wrong(stable) <= wrong(schoolbook) / 50);
        CHECK(wrong(in_double) == 0);
    }
}

TEST_CASE("a tangent, an origin on the surface or at the centre, and an interval that holds only one root") {
    const Sphere unit;
    const auto check = [&](auto test) {
        using Test = decltype(test);
        CHECK(Test::intersect({{1, 0, 5}, {0, 0, -1}}, unit) == 5.0f);  // tangent
        CHECK_FALSE(Test::intersect({{1.001f, 0, 5}, {0, 0, -1}}, unit));
        CHECK(Test::intersect({{0, 0, 1}, {0, 0, -1}}, unit) == 0.0f);           // on the surface
        CHECK(Test::intersect({{0, 0, 0}, {0, 0, 2}}, unit) == 0.5f);            // at the centre
        CHECK(Test::intersect({{0, 0, 3}, {0, 0, -1}, 2.5f, 9}, unit) == 4.0f);  // the far root only
        CHECK_FALSE(Test::intersect({{0, 0, 3}, {0, 0, -1}, 2.5f, 3.5f}, unit));
        CHECK(Test::intersect({{0, 0, 3}, {0, 0, -1}, -infinity, infinity}, unit) == 2.0f);
        CHECK(Test::intersect({{0, 0, 3}, {0, 0, 1}, -infinity, infinity}, unit) == -4.0f);
    };
    check(SphereSchoolbook{});
    check(SphereStable{});
    check(SphereDouble{});
}

TEST_CASE("a plane across an axis is met where the general plane is") {
    Pcg32 random(703);
    for (int i = 0; i < 1'000; ++i) {
        const int axis = static_cast<int>(random.below(3));
        Vector3 n(0.0f);
        n[axis] = 1.0f;
        const Ray ray{random_vector(random), random_vector(random)};
        const float position = random.uniform();
        CHECK(plane_t(ray, Plane{n, position}) == plane_t(ray, AxisPlane{axis, position}));
    }
    CHECK(std::isinf(plane_t({{0, 0, 0}, {0, 1, 0}}, AxisPlane{0, 1.0f})));
}

}  // namespace space
