#include "ex06_orientation_filter.hpp"

#include "chapters/ch02_intersection_tests/expansion.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

using namespace space;

namespace {

int exact_sign(const Point2& a, const Point2& b, const Point2& c) {
    return (difference(b.x, a.x) * difference(c.y, a.y) -
            difference(b.y, a.y) * difference(c.x, a.x))
        .sign();
}

/// |determinant| in units of u24 (|left| + |right|), to within a float's rounding.
double certainty(const Point2& a, const Point2& b, const Point2& c) {
    const Double2 ab = Double2(b) - Double2(a), ac = Double2(c) - Double2(a);
    const double left = ab.x * ac.y, right = ab.y * ac.x;
    return std::abs(left - right) / (0x1p-24 * (std::abs(left) + std::abs(right)));
}

void check(const Point2& a, const Point2& b, const Point2& c) {
    int asked = 0;
    const int found = orientation(a, b, c, [&](const Point2& p, const Point2& q, const Point2& r) {
        ++asked;
        return exact_sign(p, q, r);
    });
    const int wanted = exact_sign(a, b, c);
    const bool in_vain = asked > 0 && certainty(a, b, c) > 20.0;
    if (found == wanted && !in_vain && asked <= 1) return;
    CAPTURE(a, b, c, asked, Number{certainty(a, b, c)});
    REQUIRE(found == wanted);
    REQUIRE_FALSE(in_vain);
    REQUIRE(asked <= 1);
}

}  // namespace

TEST_CASE("a left turn, a right turn and none") {
    check({0, 0}, {4, 0}, {4, 3});
    check({0, 0}, {4, 0}, {4, -3});
    check({0, 0}, {4, 0}, {8, 0});
    check({1, 1}, {1, 1}, {2, 3});
    check({1, 1}, {2, 3}, {1, 1});
    check({1, 1}, {1, 1}, {1, 1});
}

TEST_CASE("no point around (1/2, 1/2) is on the wrong side of the line through (12, 12)") {
    // The figure of Kettner, Mehlhorn, Pion, Schirra & Yap 2008 ("Classroom examples of robustness
    // problems in geometric computations"), in floats.
    for (int i = 0; i < 256; ++i)
        for (int j = 0; j < 256; ++j)
            check(Point2(0.5f) + 0x1p-24f * Point2(i, j), {12, 12}, {24, 24});
}

TEST_CASE("three points whose determinant is off by 2.6 u24 (|left| + |right|), at any scale") {
    for (const float scale : {1.0f, 0x1p-20f, 0x1p20f})
        check(scale * Point2(-0x1.aa1798p-3f, -0x1.02c652p-1f),
              scale * Point2(0x1.d83d34p-1f, 0x1.057c04p-1f),
              scale * Point2(-0x1.54b4eep+0f, -0x1.83c6dap+0f));
}

TEST_CASE("points that nearly lie on a line turn as they do in exact arithmetic, at any scale") {
    Pcg32 random(26);
    const Aabb2 square{Point2(-1), Point2(1)};
    for (int i = 0; i < 200'000; ++i) {
        const float scale = std::ldexp(1.0f, static_cast<int>(random.below(61)) - 30);
        const Point2 a = scale * random_point(random, square);
        const Point2 b = scale * random_point(random, square);
        const float t = random.uniform(-2, 2);
        check(a, b, a + t * (b - a));
    }
}

TEST_CASE("points far from the origin turn as they do in exact arithmetic") {
    Pcg32 random(27);
    for (int i = 0; i < 100'000; ++i) {
        const auto place = [&] { return 1000.0f + 0x1p-13f * static_cast<float>(random.below(9)); };
        Point2 points[3];
        for (Point2& p : points)
            for (int axis = 0; axis < 2; ++axis) p[axis] = place();
        check(points[0], points[1], points[2]);
    }
}

TEST_CASE("a point close to the origin and two far ones turn as they do in exact arithmetic") {
    // A double loses what the small numbers add to the large ones.
    Pcg32 random(29);
    for (int i = 0; i < 20'000; ++i) {
        const float scale = std::ldexp(1.0f, -static_cast<int>(20 + random.below(40)));
        const Point2 a = scale * random_point(random, Aabb2{Point2(-1), Point2(1)});
        const Point2 b = random_point(random, Aabb2{Point2(1), Point2(2)});
        check(a, b, 2.0f * b);
    }
}

TEST_CASE("random points ask for nothing, or nearly so") {
    Pcg32 random(28);
    const Aabb2 square{Point2(-1), Point2(1)};
    int asked = 0;
    for (int i = 0; i < 100'000; ++i) {
        const Point2 a = random_point(random, square), b = random_point(random, square),
                     c = random_point(random, square);
        orientation(a, b, c, [&](const Point2& p, const Point2& q, const Point2& r) {
            ++asked;
            return exact_sign(p, q, r);
        });
    }
    CHECK(asked <= 20);
}
