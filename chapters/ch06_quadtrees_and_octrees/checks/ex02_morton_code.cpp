#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

// The exercise is to do without the chapter's own: the compiler refuses it from here on.
#pragma GCC poison OrthtreeCell
#include "ex02_morton_code.hpp"

using namespace space;

namespace {

/// The last place on the first axis, alone.
constexpr std::uint64_t all_ones = 0111111111111111111111;

/// In base 8: a digit is the number of a child, the first one that of the root's.
std::string children_of(std::uint64_t code) {
    return fmt::format("{:021o}", code);
}
std::string way_to(const Point3& point) {
    return children_of(morton_code_of(point));
}

/// By halving the root 21 times.
std::uint64_t by_halving(const Point3& point) {
    Double3 corner(0.0);
    std::uint64_t code = 0;
    for (double half = 0.5; half >= 0x1p-21; half *= 0.5) {
        std::uint64_t child = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(double{point[axis]} >= corner[axis] + half)) continue;
            corner[axis] += half;
            child += 1u << axis;
        }
        code = 8 * code + child;
    }
    return code;
}

int depth_by_halving(std::uint64_t a, std::uint64_t b) {
    int depth = 21;
    for (; a != b; --depth) {
        a /= 8;
        b /= 8;
    }
    return depth;
}

Point3 along(int axis, float p) {
    Point3 point(0.0f);
    point[axis] = p;
    return point;
}

/// The centres of all cells at a depth, in the order in which a walk from the root comes to them.
void walk(const Double3& corner, double edge, int depth, std::vector<Point3>& centres) {
    if (depth == 0) {
        centres.push_back(Point3(corner + 0.5 * edge));
        return;
    }
    for (int child = 0; child < 8; ++child)
        walk(corner + 0.5 * edge * Double3(child & 1, child >> 1 & 1, child >> 2), 0.5 * edge,
             depth - 1, centres);
}

/// From 0 to 1; also near 0, near 1, and on planes.
float random_coordinate(Pcg32& random) {
    const std::uint32_t kind = random.below(4);
    if (kind == 0) return static_cast<float>(random.below((1u << 21) + 1)) * 0x1p-21f;
    const int smaller = kind == 1 ? 0 : int(random.below(28));
    const float p = std::ldexp(random.uniform(), -smaller);
    return kind == 3 ? 1.0f - p : p;
}
Point3 random_in_cube(Pcg32& random) {
    Point3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = random_coordinate(random);
    return point;
}

}  // namespace

TEST_CASE("the first digit is the root's child: 1 for upper in x, 2 in y, 4 in z") {
    for (int child = 0; child < 8; ++child) {
        const Point3 point =
            0.25f + 0.5f * Point3(float(child & 1), float(child >> 1 & 1), float(child >> 2));
        CAPTURE(point);
        REQUIRE(way_to(point).substr(0, 1) == std::to_string(child));
    }
}

TEST_CASE("the cells after the first one have the codes 1, 2 and 4 on their axes") {
    CHECK(morton_code_of({0, 0, 0}) == 0);
    CHECK(morton_code_of(along(0, 0x1p-21f)) == 1);
    CHECK(morton_code_of(along(1, 0x1p-21f)) == 2);
    CHECK(morton_code_of(along(2, 0x1p-21f)) == 4);
}

TEST_CASE("bit i of axis a is bit 3 i + a, up to bit 62") {
    for (int axis = 0; axis < 3; ++axis)
        for (int i = 0; i < 21; ++i) {
            CAPTURE(axis, i);
            REQUIRE(way_to(along(axis, std::ldexp(1.0f, i - 21))) ==
                    children_of(std::uint64_t{1} << (3 * i + axis)));
        }
}

TEST_CASE("what lies on the root's upper faces is in the last cell of its axis") {
    for (int axis = 0; axis < 3; ++axis) {
        CAPTURE(axis);
        const float last_cell = 1.0f - 0x1p-22f;
        REQUIRE(way_to(along(axis, 1.0f)) == children_of(all_ones << axis));
        REQUIRE(way_to(along(axis, last_cell)) == way_to(along(axis, 1.0f)));
        REQUIRE(way_to(along(axis, 1.0f - 0x1p-21f - 0x1p-24f)) != way_to(along(axis, last_cell)));
    }
    CHECK(way_to({1, 1, 1}) == "777777777777777777777");
}

TEST_CASE("a point between two cells is in the upper one, the float before it in the lower") {
    Pcg32 random(3);
    for (int depth = 1; depth <= 21; ++depth)
        for (int i = 0; i < 40; ++i) {
            const std::uint32_t place = 1 + random.below((1u << depth) - 1);
            const float plane = std::ldexp(float(place), -depth);
            CAPTURE(depth, place, Number{plane});
            REQUIRE(way_to({plane, 0, 0}) == children_of(by_halving({plane, 0, 0})));
            const float before = std::nextafter(plane, 0.0f);
            REQUIRE(way_to({0, before, 0}) == children_of(by_halving({0, before, 0})));
        }
    CHECK(morton_code_of({std::numeric_limits<float>::denorm_min(), -0.0f, 0x1p-22f}) == 0);
}

TEST_CASE("the order of the codes is that in which a walk from the root comes to the cells") {
    for (int depth = 1; depth <= 3; ++depth) {
        std::vector<Point3> centres;
        walk(Double3(0.0), 1.0, depth, centres);
        for (std::size_t i = 0; i + 1 < centres.size(); ++i) {
            CAPTURE(depth, centres[i], centres[i + 1]);
            REQUIRE(way_to(centres[i]) < way_to(centres[i + 1]));
        }
    }
}

TEST_CASE("random points of the cube have the codes that halving finds") {
    Pcg32 random(1);
    for (int i = 0; i < sized(50'000, 5'000); ++i) {
        const Point3 point = random_in_cube(random);
        CAPTURE(point);
        REQUIRE(way_to(point) == children_of(by_halving(point)));
    }
}

TEST_CASE(
    "equal codes share their smallest cell; those of two children of the root share the root") {
    for (const std::uint64_t code : {std::uint64_t{0}, std::uint64_t{1} << 62, 7 * all_ones}) {
        CAPTURE(children_of(code));
        REQUIRE(common_depth(code, code) == 21);
    }
    for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b) {
            if (a == b) continue;
            const std::uint64_t first = std::uint64_t(a) << 60, second = std::uint64_t(b) << 60;
            CAPTURE(children_of(first), children_of(second));
            REQUIRE(common_depth(first, second) == 0);
        }
}

TEST_CASE("codes share as many cells as first digits, whichever bit is the first to differ") {
    Pcg32 random(2);
    for (int bit = 0; bit < 63; ++bit) {
        const std::uint64_t ones = (std::uint64_t{2} << bit) - 1;
        CAPTURE(children_of(ones));
        REQUIRE(common_depth(0, ones) == depth_by_halving(0, ones));
        for (int i = 0; i < 100; ++i) {
            const std::uint64_t high = random.next(), low = random.next();
            const std::uint64_t a = (high << 32 | low) >> 1;
            std::uint64_t b = a ^ std::uint64_t{1} << bit;
            for (int lower = 0; lower < bit; ++lower) b ^= std::uint64_t{random.below(2)} << lower;
            CAPTURE(children_of(a), children_of(b));
            REQUIRE(common_depth(a, b) == depth_by_halving(a, b));
            REQUIRE(common_depth(b, a) == depth_by_halving(a, b));
        }
    }
}
