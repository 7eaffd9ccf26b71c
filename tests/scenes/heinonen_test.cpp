// The seven segments give the sets that Heinonen16 publishes; all in integers, in quarters of a
// unit.
#include "common/scene.hpp"
#include "tests/catch.hpp"

#include <cmath>
#include <string>

namespace space {
namespace {

struct Quarters {
    long x, y;
};
Quarters quarters(const Point2& p) {
    REQUIRE(p.x * 4 == std::floor(p.x * 4));
    REQUIRE(p.y * 4 == std::floor(p.y * 4));
    return {std::lround(p.x * 4), std::lround(p.y * 4)};
}

/// Positive where p is on the left of a -> b: in front.
long side(const Segment& splitter, const Point2& point) {
    const Quarters a = quarters(splitter.a), b = quarters(splitter.b), p = quarters(point);
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

const Segment& named(char name) {
    static const std::vector<Segment> segments = heinonen_segments();
    return segments.at(static_cast<std::size_t>(name - 'A'));
}

/// Of the segments, those with both ends strictly on the side of `sign`.
std::string wholly(const std::string& names, char splitter, int sign) {
    std::string found;
    for (const char name : names)
        if (sign * side(named(splitter), named(name).a) > 0 &&
            sign * side(named(splitter), named(name).b) > 0)
            found += name;
    return found;
}

std::string beyond(const std::string& names, int axis, float position, int sign) {
    std::string found;
    for (const char name : names) {
        const float a = named(name).a[axis] - position, b = named(name).b[axis] - position;
        if (float(sign) * a > 0 && float(sign) * b > 0) found += name;
    }
    return found;
}

TEST_CASE("BSP splitters G, E, B, A give the sets of Heinonen16, figures 2 and 3", "[scenes]") {
    CHECK(wholly("ABCDEF", 'G', +1) == "ABC");
    CHECK(wholly("ABCDEF", 'G', -1) == "DEF");
    CHECK(wholly("DF", 'E', +1) == "D");
    CHECK(wholly("DF", 'E', -1) == "F");
    CHECK(wholly("A", 'B', +1) == "A");
    CHECK(side(named('B'), named('C').a) < 0);  // B cuts C: its first end is behind,
    CHECK(side(named('B'), named('C').b) > 0);  // its second in front
    CHECK(wholly("C", 'A', +1) == "C");  // so C1, its part in front of B, is wholly in front of A
}

TEST_CASE(
    "k-d planes q, r, s, t, u, v give the sets of Heinonen16, figures 4 and 5, and cut nothing",
    "[scenes]") {
    CHECK(beyond("ABCDEFG", 0, 8.0f, +1) == "CEFG");
    CHECK(beyond("ABCDEFG", 0, 8.0f, -1) == "ABD");
    CHECK(beyond("CEFG", 1, 6.5f, +1) == "CG");
    CHECK(beyond("CEFG", 1, 6.5f, -1) == "EF");
    CHECK(beyond("CG", 0, 12.5f, +1) == "C");
    CHECK(beyond("CG", 0, 12.5f, -1) == "G");
    CHECK(beyond("EF", 0, 11.25f, +1) == "F");
    CHECK(beyond("EF", 0, 11.25f, -1) == "E");
    CHECK(beyond("ABD", 1, 11.5f, +1) == "A");
    CHECK(beyond("ABD", 1, 11.5f, -1) == "BD");
    CHECK(beyond("BD", 0, 4.0f, +1) == "B");
    CHECK(beyond("BD", 0, 4.0f, -1) == "D");
}

TEST_CASE("the seven segments lie in the square of side 16 and do not meet", "[scenes]") {
    for (const Segment& segment : heinonen_segments())
        for (const Point2& p : {segment.a, segment.b}) {
            CHECK(p.x >= 0.0f);
            CHECK(p.y >= 0.0f);
            CHECK(p.x <= 16.0f);
            CHECK(p.y <= 16.0f);
        }
    for (char i = 'A'; i <= 'G'; ++i)
        for (char j = 'A'; j < i; ++j) {
            const Segment &s = named(i), &t = named(j);
            const bool apart = side(s, t.a) * side(s, t.b) > 0 || side(t, s.a) * side(t, s.b) > 0;
            CHECK(apart);
        }
}

}  // namespace
}  // namespace space
