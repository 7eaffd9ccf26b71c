#include "ex01_classify_a_polygon.hpp"

#include "tests/check.hpp"

#include <array>
#include <vector>

namespace space {

static std::ostream& operator<<(std::ostream& out, PlaneSide side) {
    constexpr std::array names{"front", "back", "coplanar", "straddling"};
    return out << names[static_cast<std::size_t>(side)];
}

}  // namespace space

using namespace space;

namespace {

using Polygon = std::vector<Point3>;

const SplitPlane<3> floor_plane({Point3(0, 0, 0), Point3(1, 0, 0),
                                 Point3(0, 1, 0)});  // front: z > 0

}  // namespace

TEST_CASE("a triangle in front, one behind, one on the plane and one across it") {
    CHECK(classify(Polygon{{0, 0, 1}, {4, 0, 2}, {0, 4, 3}}, floor_plane) == PlaneSide::front);
    CHECK(classify(Polygon{{0, 0, -1}, {4, 0, -2}, {0, 4, -3}}, floor_plane) == PlaneSide::back);
    CHECK(classify(Polygon{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, floor_plane) == PlaneSide::coplanar);
    CHECK(classify(Polygon{{0, 0, 1}, {4, 0, -2}, {0, 4, 3}}, floor_plane) ==
          PlaneSide::straddling);
}

TEST_CASE("a polygon that touches the plane with a corner or an edge does not lie across it") {
    CHECK(classify(Polygon{{0, 0, 0}, {4, 0, 1}, {0, 4, 1}}, floor_plane) == PlaneSide::front);
    CHECK(classify(Polygon{{0, 0, -1}, {4, 0, 0}, {0, 4, 0}}, floor_plane) == PlaneSide::back);
    CHECK(classify(Polygon{{0, 0, 0}, {4, 0, 0}, {4, 0, 4}, {0, 0, 4}}, floor_plane) ==
          PlaneSide::front);
}

TEST_CASE("a square that the plane cuts from corner to corner lies across it") {
    const Polygon square{{0, 0, 0}, {2, 0, 2}, {4, 0, 0}, {2, 0, -2}};
    CHECK(classify(square, floor_plane) == PlaneSide::straddling);
}

TEST_CASE("a corner that is only just off the plane is off it") {
    for (const float off : {0x1p-10f, 0x1p-20f, 0x1p-30f, 0x1p-100f}) {
        CAPTURE(Number{off});
        REQUIRE(classify(Polygon{{0, 0, off}, {4, 0, 0}, {0, 4, 0}}, floor_plane) ==
                PlaneSide::front);
        REQUIRE(classify(Polygon{{0, 0, 0}, {4, 0, -off}, {0, 4, 0}}, floor_plane) ==
                PlaneSide::back);
        REQUIRE(classify(Polygon{{0, 0, 2}, {4, 0, -off}, {0, 4, 0}}, floor_plane) ==
                PlaneSide::straddling);
        REQUIRE(classify(Polygon{{0, 0, off}, {4, 0, -off}, {0, 4, off}}, floor_plane) ==
                PlaneSide::straddling);
    }
}

TEST_CASE("the plane's position and facing count") {
    const Polygon triangle{{0, 0, 1}, {4, 0, 1}, {0, 4, 2}};
    CHECK(classify(triangle, SplitPlane<3>({Point3(0, 0, 0), Point3(0, 1, 0), Point3(1, 0, 0)})) ==
          PlaneSide::back);
    CHECK(classify(triangle, SplitPlane<3>({Point3(0, 0, 1), Point3(1, 0, 1), Point3(0, 1, 1)})) ==
          PlaneSide::front);
    CHECK(classify(triangle, SplitPlane<3>({Point3(0, 0, 3), Point3(1, 0, 3), Point3(0, 1, 3)})) ==
          PlaneSide::back);
}

TEST_CASE("every sequence of corners in front, on and behind is classified by all of its corners") {
    // ax + by + cz = abc, and a corner on each of its sides and on it; a, b, c without a common
    // factor.
    const auto [a, b, c] = GENERATE(std::array{3, 5, 7}, std::array{7, 11, 13}, std::array{1, 9, 2},
                                    std::array{17, 3, 10});
    const SplitPlane<3> plane({Point3(b * c, 0, 0), Point3(0, a * c, 0), Point3(0, 0, a * b)});
    int cases = 0;
    for (int count = 3, sequences = 27; count <= 5; ++count, sequences *= 3)
        for (int sequence = 0; sequence < sequences; ++sequence) {
            Polygon polygon;
            std::array<bool, 3> seen{};
            for (int i = 0, rest = sequence; i < count; ++i, rest /= 3) {
                const int side = rest % 3;  // 0 behind, 1 on, 2 in front
                seen[static_cast<std::size_t>(side)] = true;
                polygon.push_back({b * c - b * i + side - 1, a * i, 0});
            }
            const PlaneSide expected = seen[0] && seen[2] ? PlaneSide::straddling
                                       : seen[2]          ? PlaneSide::front
                                       : seen[0]          ? PlaneSide::back
                                                          : PlaneSide::coplanar;
            ++cases;
            CAPTURE(polygon);
            REQUIRE(classify(polygon, plane) == expected);
        }
    CHECK(cases == 27 + 81 + 243);
}
