#include "chapters/ch02_intersection_tests/expansion.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bounding_sphere.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

// The exercise is to do without the chapter's own: the compiler refuses it from here on.
#pragma GCC poison merged reach sphere_about ritter_sphere smallest_sphere
#include "ex01_sphere_around_both.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace Catch {
template <>
struct StringMaker<space::BoundingSphere<3>> {
    static std::string convert(const space::BoundingSphere<3>& sphere) {
        return "radius " + fmt::format("{}", sphere.radius) + " about " +
               Detail::stringify(sphere.centre);
    }
};
}  // namespace Catch

using namespace space;

namespace {

using Sphere3 = BoundingSphere<3>;

/// The inner one's centre is no farther than the difference of the radii: squared, by exact sums.
bool exactly_in(const Sphere3& inner, const Sphere3& outer) {
    if (!(outer.radius >= inner.radius)) return false;
    const auto square = [](float to, float from) {
        const Expansion<2> d = difference(to, from);
        return d * d;
    };
    return (square(outer.radius, inner.radius) - square(outer.centre.x, inner.centre.x) -
            square(outer.centre.y, inner.centre.y) - square(outer.centre.z, inner.centre.z))
               .sign() >= 0;
}

/// The smallest sphere, in double.
struct Smallest {
    Double3 centre;
    double radius;
};
Smallest smallest(const Sphere3& a, const Sphere3& b) {
    const Double3 way = Double3(b.centre) - Double3(a.centre);
    const double distance = glm::length(way);
    if (distance + b.radius <= a.radius) return {Double3(a.centre), a.radius};
    if (distance + a.radius <= b.radius) return {Double3(b.centre), b.radius};
    const double radius = 0.5 * (a.radius + distance + b.radius);
    return {Double3(a.centre) + (radius - a.radius) / distance * way, radius};
}

void check(const Sphere3& a, const Sphere3& b) {
    const Sphere3 both = sphere_around_both(a, b);
    CAPTURE(a, b, both);
    REQUIRE(exactly_in(a, both));
    REQUIRE(exactly_in(b, both));
    const Smallest wanted = smallest(a, b);
    double largest = both.radius;
    for (int axis = 0; axis < 3; ++axis)
        largest =
            std::max({largest, std::abs(double{a.centre[axis]}), std::abs(double{b.centre[axis]})});
    const Error off{glm::distance(Double3(both.centre), wanted.centre), 0x1p-22 * largest};
    REQUIRE(off);
    const auto up_to = [&](const Sphere3& sphere) {
        return glm::distance(Double3(both.centre), Double3(sphere.centre)) + sphere.radius;
    };
    const Error radius{both.radius, std::max(up_to(a), up_to(b)) * (1.0 + 0x1p-22)};
    REQUIRE(radius);
}

float any_size(Pcg32& random) {
    const int exponent = int(random.below(13)) - 6;
    return std::ldexp(random.uniform(), exponent);
}

}  // namespace

TEST_CASE("two spheres apart: from the far end of one to the far end of the other") {
    check({{0, 0, 0}, 1}, {{4, 0, 0}, 1});
    check({{0, 0, 0}, 1}, {{8, 0, 0}, 3});
    check({{2, 2, 2}, 3}, {{2, -10, 2}, 1});
}

TEST_CASE("two spheres that overlap") {
    check({{0, 0, 0}, 2}, {{1, 0, 0}, 2});
    check({{0, 0, 1}, 2}, {{0, 0, 3.5f}, 1});
    check({{0, 0, 0}, 4}, {{3, 4, 0}, 2});
}

TEST_CASE("a sphere inside of the other, whichever comes first: the other one as it is") {
    const Sphere3 large{{1, 2, 3}, 5}, small{{2, 3, 3}, 1.5f};
    CHECK(sphere_around_both(large, small) == large);
    CHECK(sphere_around_both(small, large) == large);
    const Sphere3 beside{{1, 2, 3}, 2};
    CHECK(sphere_around_both(large, beside) == large);
    CHECK(sphere_around_both(beside, large) == large);
}

TEST_CASE("a sphere that is inside of the other by less than floats show is inside") {
    Pcg32 random(2);
    for (int i = 0; i < 1'000; ++i) {
        const Sphere3 large{random_vector(random), 1.0f + random.uniform()};
        const Point3 centre = large.centre + 0.5f * random_vector(random);
        const double room = large.radius - glm::distance(Double3(centre), Double3(large.centre));
        const Sphere3 small{centre, float_below(room * (1.0 - 0x1p-40))};
        CAPTURE(large, small);
        REQUIRE(sphere_around_both(large, small) == large);
        REQUIRE(sphere_around_both(small, large) == large);
    }
}

TEST_CASE("a sphere and itself are that sphere") {
    const Sphere3 sphere{{0.1f, -7, 0.3f}, 0.7f}, point{{0.1f, 0.2f, 0.3f}, 0};
    CHECK(sphere_around_both(sphere, sphere) == sphere);
    CHECK(sphere_around_both(point, point) == point);
}

TEST_CASE("with an empty one it is the other, and of two empty ones it is empty") {
    const Sphere3 sphere{{1, 2, 3}, 0.5f}, point{{1, 2, 3}, 0}, empty{}, other{{9, 9, 9}, -2.0f};
    CHECK(sphere_around_both(sphere, empty) == sphere);
    CHECK(sphere_around_both(empty, sphere) == sphere);
    CHECK(sphere_around_both(other, sphere) == sphere);
    CHECK(sphere_around_both(point, other) == point);
    CHECK(sphere_around_both(other, point) == point);
    CHECK(sphere_around_both(empty, empty).is_empty());
}

TEST_CASE("two points: half of their distance") {
    check({{0, 0, 0}, 0}, {{2, 0, 0}, 0});
    check({{0.1f, 0.2f, 0.3f}, 0}, {{0.7f, -0.4f, 1.9f}, 0});
}

TEST_CASE("a distance that double rounds to a float is a little more than that float") {
    check({{-1, 0, 0}, 0}, {{1, 0x1p-29f, 0}, 0});
    check({{-1, 0, 3}, 2}, {{1, 0x1p-29f, 3}, 2});
}

TEST_CASE("a sphere that is touched by the other from inside grows by no more than roundings") {
    check({{0, 0, 0}, 5}, {{3, 0, 0}, 2});
    check({{0, 0, 0}, 5}, {{0, 4, 0}, std::nextafter(1.0f, 2.0f)});
}

TEST_CASE("random spheres of many sizes, near and far: both are inside, and nothing is wasted") {
    Pcg32 random(1);
    for (int i = 0; i < sized(50'000, 5'000); ++i) {
        const float spread = any_size(random), shift = random.below(2) ? 0.0f : 100.0f;
        const Point3 p = spread * random_vector(random) + shift;
        const Point3 q = spread * random_vector(random) + shift;
        const float r = any_size(random);
        const float s = any_size(random);
        check({p, r}, {q, s});
    }
}
