#include "chapters/ch02_intersection_tests/spheres.hpp"

#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "chapters/ch02_intersection_tests/planes.hpp"
#include "tests/catch.hpp"

namespace space::ch02 {
namespace {

constexpr std::uint64_t rays = 20'000;
constexpr std::size_t schoolbook = 1, stable = 2, in_double = 3;

}  // namespace

TEST_CASE(
    "the printed sphere test hits as many spheres behind the origin as before it, but for chance") {
    const SpheresBehind found = spheres_behind(rays, 701);
    const auto before = static_cast<double>(found.exact_hits),
               behind = static_cast<double>(found.behind);
    CHECK(before > 0.0);
    CHECK(std::abs(behind - before) <=
          3.0 * std::sqrt(before + behind));  // three standard deviations
    CHECK(found.printed_hits == found.exact_hits + found.behind);
}

TEST_CASE("a sphere behind the origin is hit by the printed test and by none of the others") {
    Pcg32 random(704);
    for (std::uint64_t i = 0; i < rays; ++i) {
        const Sphere sphere{random_vector(random), 1.0f};
        const Double3 at = Double3(sphere.centre) + 0.9 * random_direction(random);
        const Point3 origin(Double3(sphere.centre) + 3.0 * random_direction(random));
        const Ray ray{origin, Point3(Double3(origin) - at)};  // straight away from a point inside
        REQUIRE(SphereAsPrinted::hits(ray, sphere));
        REQUIRE_FALSE(SphereSchoolbook::intersect(ray, sphere));
        REQUIRE_FALSE(SphereStable::intersect(ray, sphere));
        REQUIRE_FALSE(SphereDouble::intersect(ray, sphere));
    }
}

TEST_CASE(
    "from 3000 radii away the schoolbook's t is off by 0.4 radii, the others' only by its rounding "
    "to float") {
    const Ray ray{{0.9f, 0, 3000}, {0, 0, -1}};
    const double exact = 3000.0 - std::sqrt(1.0 - double{0.9f} * 0.9f);
    constexpr double half_ulp = 0x1p-13;  // of floats from 2048 to 4096
    CHECK(std::abs(SphereSchoolbook::intersect(ray, {}).value() - exact) > 0.4);
    CHECK(std::abs(SphereStable::intersect(ray, {}).value() - exact) <= half_ulp);
    CHECK(std::abs(SphereDouble::intersect(ray, {}).value() - exact) <= half_ulp);
}

TEST_CASE(
    "far away the stable test decides wrongly at most a thousandth as often as the schoolbook's, "
    "and the one in "
    "double never") {
    for (const double distance : {300.0, 3e3, 3e4}) {
        const SphereAccuracy found = sphere_accuracy(distance, rays, 702, 2);
        const auto wrong = [&](std::size_t test) {
            return found.wrong[test].hits + found.wrong[test].misses;
        };
        INFO(distance << " radii: schoolbook " << wrong(schoolbook) << ", stable " << wrong(stable)
                      << ", double " << wrong(in_double));
        CHECK(wrong(schoolbook) > rays / 500);
        CHECK(1000 * wrong(stable) <= wrong(schoolbook));
        CHECK(wrong(in_double) == 0);
    }
}

TEST_CASE(
    "a tangent, an origin on the surface or at the centre and an interval with one root or none "
    "are decided exactly") {
    const Sphere unit;
    const auto check = [&](auto test) {
        using Test = decltype(test);
        CHECK(Test::intersect({{1, 0, 5}, {0, 0, -1}}, unit) == 5.0f);  // tangent
        CHECK_FALSE(Test::intersect({{1.001f, 0, 5}, {0, 0, -1}}, unit));
        CHECK(Test::intersect({{0, 0, 1}, {0, 0, -1}}, unit) == 0.0f);  // on the surface
        CHECK(Test::intersect({{0, 0, 0}, {0, 0, 2}}, unit) == 0.5f);   // at the centre
        CHECK(Test::intersect({{0, 0, 3}, {0, 0, -1}, 2.5f, 9}, unit) ==
              4.0f);  // the far root only
        CHECK_FALSE(Test::intersect({{0, 0, 3}, {0, 0, -1}, 2.5f, 3.5f}, unit));
        CHECK(Test::intersect({{0, 0, 3}, {0, 0, -1}, -infinity, infinity}, unit) == 2.0f);
        CHECK(Test::intersect({{0, 0, 3}, {0, 0, 1}, -infinity, infinity}, unit) == -4.0f);
    };
    check(SphereSchoolbook{});
    check(SphereStable{});
    check(SphereDouble{});
}

TEST_CASE("a ray that touches the sphere where it starts hits it at t = 0") {
    // b = 0 and discriminant 0: both roots are 0, and their product over their sum is 0 / 0.
    for (const Vector3 way : {Vector3(0, 1, 0), Vector3(0, -2, 0), Vector3(0, 0, 3)}) {
        const Ray ray{{1, 0, 0}, way, -1.0f, 1.0f};
        CHECK(SphereStable::intersect(ray, {}) == 0.0f);
        CHECK(SphereDouble::intersect(ray, {}) == 0.0f);
    }
}

TEST_CASE(
    "where a ray leaves the sphere from just inside the stable t has all its digits, and the "
    "schoolbook's half of them") {
    Pcg32 random(705);
    double stable = 0.0, schoolbook = 0.0;
    for (int i = 0; i < 1'000; ++i) {
        // f . f - r^2 is a float, exactly: what is lost is lost later.
        const Ray ray{{1.0f - 0x1p-11f, 0, 0},
                      {random.uniform(0.25f, 1.0f), random.uniform(), random.uniform()}};
        const Double3 f{ray.origin}, d{ray.direction};
        const double a = glm::dot(d, d), b = glm::dot(f, d), c = glm::dot(f, f) - 1.0;
        const double exact = -c / (b + std::sqrt(b * b - a * c));
        const auto error = [&](std::optional<float> t) { return std::abs(*t / exact - 1.0); };
        stable = std::max(stable, error(SphereStable::intersect(ray, {})));
        schoolbook = std::max(schoolbook, error(SphereSchoolbook::intersect(ray, {})));
        REQUIRE(error(SphereDouble::intersect(ray, {})) <= 0x1p-24);
    }
    CHECK(stable < 16 * 0x1p-24);
    CHECK(schoolbook > 1000 * 0x1p-24);
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

}  // namespace space::ch02
