#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using namespace space;

using Four = std::array<Triangle, 4>;

/// The lanes that the ray's line hits in exact arithmetic.
unsigned hit_lanes(Ray ray, const Four& triangles) {
    ray.tmin = -infinity;
    ray.tmax = infinity;
    unsigned lanes = 0;
    for (unsigned lane = 0; lane < 4; ++lane)
        lanes |= unsigned{FilteredExact::intersect(ray, triangles[lane]).has_value()} << lane;
    return lanes;
}

/// What the exercise promises: 0, or from 2^-20 on.
Point3 tame(Point3 p) {
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(p[axis]) < 0x1p-20f) p[axis] = 0.0f;
    return p;
}
/// A point of the segment, rounded.
Point3 between(Pcg32& random, const Point3& p, const Point3& q) {
    const double share = random.uniform_double();
    return tame(Point3(Double3(p) + share * (Double3(q) - Double3(p))));
}
Ray aimed(const Point3& origin, const Point3& target) {
    return {.origin = origin, .direction = tame(target - origin)};
}
/// As large as asked for, anywhere in a cube of 2 about `middle`.
Triangle random_triangle(Pcg32& random, const Point3& middle, float size) {
    const Point3 at = middle + random_vector(random);
    const Point3 a = at + size * random_vector(random);
    const Point3 b = at + size * random_vector(random);
    const Point3 c = at + size * random_vector(random);
    return {tame(a), tame(b), tame(c)};
}

}  // namespace

// Floats alone, and no exact test: the compiler refuses all else from here on.
#pragma GCC poison double Double2 Double3 dvec2 dvec3 FilteredExact Expansion Int128
#include "ex05_four_lane_filter.hpp"

namespace {

FourTriangles block(const Four& triangles) {
    FourTriangles four;
    for (std::size_t lane = 0; lane < 4; ++lane)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            four.a[axis][lane] = triangles[lane].a[int(axis)];
            four.b[axis][lane] = triangles[lane].b[int(axis)];
            four.c[axis][lane] = triangles[lane].c[int(axis)];
        }
    return four;
}
std::string names(unsigned lanes) {
    std::string text;
    for (unsigned lane = 0; lane < 32; ++lane)
        if ((lanes >> lane & 1u) != 0) text += fmt::format("{}{}", text.empty() ? "" : " ", lane);
    return text.empty() ? "none" : text;
}
/// The lanes that the answer leaves to the exact test.
std::string left(const Ray& ray, const Four& triangles) {
    return names(may_be_hit(ray, block(triangles)));
}

void check_no_hit_is_lost(const Ray& ray, const Four& triangles) {
    const unsigned hit = hit_lanes(ray, triangles), found = may_be_hit(ray, block(triangles));
    if ((hit & ~found) != 0) {
        CAPTURE(ray, names(hit), names(found), triangles[0], triangles[1], triangles[2],
                triangles[3]);
        FAIL("a lane that is hit has no bit");
    }
}
/// Triangles about one vertex and about its edges, and a ray at one of them.
template <class Corner>
void check_fans(std::uint64_t seed, const Corner& corner) {
    Pcg32 random(seed);
    for (int i = 0; i < sized(60'000, 3'000); ++i) {
        const Point3 origin = tame(3.0f * random_vector(random));
        const Point3 hub = corner(random);
        std::array<Point3, 4> rim;
        for (Point3& p : rim) p = corner(random);
        Four fan;
        for (std::size_t k = 0; k < 4; ++k) fan[k] = {hub, rim[k], rim[(k + 1) % 4]};
        if (i % 3 == 1)
            for (Triangle& t : fan) t = {t.b, t.c, t.a};
        if (i % 3 == 2)
            for (Triangle& t : fan) t = {t.c, t.a, t.b};
        check_no_hit_is_lost(aimed(origin, hub), fan);
        check_no_hit_is_lost(aimed(origin, between(random, hub, rim[0])), fan);
        check_no_hit_is_lost(aimed(origin, between(random, rim[0], rim[1])), fan);
    }
}

const Triangle near{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, behind{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}},
    aside{{2, 0, 1}, {3, 0, 1}, {2, 1, 1}}, turned{{0, 0, 2}, {0, 1, 2}, {1, 0, 2}};
const Ray up{.origin = {0.25f, 0.25f, 0}, .direction = {0, 0, 1}};

}  // namespace

TEST_CASE("each lane has its own bit, whichever side of a triangle is seen") {
    CHECK(left(up, {near, aside, turned, aside}) == "0 2");
    CHECK(left(up, {aside, near, aside, aside}) == "1");
    CHECK(left(up, {aside, aside, aside, turned}) == "3");
    CHECK(left(up, {aside, aside, aside, aside}) == "none");
}

TEST_CASE("where along its line the ray meets a triangle is not asked") {
    CHECK(left(up, {near, behind, turned, aside}) == "0 1 2");
    CHECK(left({up.origin, -up.direction}, {near, behind, turned, aside}) == "0 1 2");
}

TEST_CASE("what passes by on any of the three sides is a miss") {
    for (const Point3& at : {Point3(-0.1f, 0.5f, 0), Point3(0.5f, -0.1f, 0), Point3(0.6f, 0.6f, 0)})
        CHECK(left({at, {0, 0, 1}}, {near, behind, turned, near}) == "none");
}

TEST_CASE("edges and vertices belong to a triangle") {
    for (const Point3& at : {Point3(0), Point3(1, 0, 0), Point3(0, 1, 0), Point3(0.5f, 0, 0),
                             Point3(0, 0.5f, 0), Point3(0.5f, 0.5f, 0)})
        CHECK(left({at, {0, 0, 1}}, {near, behind, turned, aside}) == "0 1 2");
}

TEST_CASE("no hit is lost by a ray at a vertex or an edge that triangles share") {
    check_fans(1, [](Pcg32& random) { return tame(random_vector(random)); });
}

TEST_CASE("nor far away from small triangles") {
    check_fans(2, [](Pcg32& random) {
        const Point3 p = 0.01f * random_vector(random);
        return tame(Point3(50, 20, -30) + p);
    });
}

TEST_CASE("nor where they are seen almost from the side") {
    check_fans(3, [](Pcg32& random) {
        const Point3 p = random_vector(random);
        return tame(Point3(p.x, p.y, 1e-4f * p.z));
    });
    Pcg32 random(4);
    for (int i = 0; i < sized(60'000, 3'000); ++i) {  // the origin nearly in the plane, too
        const Point3 lift{0, 0, 1e-5f * random.uniform()};
        Four flat;
        for (Triangle& t : flat)
            for (Point3* corner : {&t.a, &t.b, &t.c}) {
                const Point3 p = random_vector(random);
                *corner = tame(Point3(p.x, p.y, 1e-6f * p.z));
            }
        const Point3 origin = tame(3.0f * Point3(1, 1, 0) + lift);
        check_no_hit_is_lost(aimed(origin, between(random, flat[0].a, flat[1].b)), flat);
        check_no_hit_is_lost(aimed(origin, flat[2].c), flat);
    }
}

TEST_CASE("nor needles, nor whatever lies on a grid") {
    check_fans(5, [](Pcg32& random) {
        const float along = 4.0f * random.uniform();
        const Point3 p = random_vector(random);
        return tame(Point3(along, along, along) + 1e-3f * p);
    });
    check_fans(6, [](Pcg32& random) {
        Point3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = float(random.below(5)) - 2.0f;
        return p;
    });
}

TEST_CASE("nor large ones, nor tiny ones, nor four of four sizes") {
    check_fans(7, [](Pcg32& random) { return tame(100'000.0f * random_vector(random)); });
    check_fans(8, [](Pcg32& random) { return tame(0x1p-14f * random_vector(random)); });
    check_fans(9, [](Pcg32& random) {
        const float size = std::ldexp(1.0f, int(random.below(30)) - 14);
        return tame(size * random_vector(random));
    });
}

TEST_CASE("of 1,000 lanes that miss at most two are left") {
    Pcg32 random(10);
    for (const float size : {1.0f, 0.1f, 0.01f}) {
        std::size_t missed = 0, left_over = 0;
        for (int i = 0; i < sized(20'000, 5'000); ++i) {
            Four triangles;
            for (Triangle& t : triangles) t = random_triangle(random, Point3(2, -1, 5), size);
            const Point3 origin = tame(3.0f * random_vector(random));
            const Point3 corner = triangles[0].a;
            const Ray ray = aimed(origin, tame(corner + size * random_vector(random)));
            const unsigned misses = 15u & ~hit_lanes(ray, triangles);
            missed += std::size_t(std::popcount(misses));
            left_over += std::size_t(std::popcount(misses & may_be_hit(ray, block(triangles))));
        }
        CAPTURE(size, missed, left_over);
        REQUIRE(1'000 * left_over <= 2 * missed);
    }
}
