#include "ex02_split_a_polygon.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace space;

namespace {

using Polygon = std::vector<Point3>;

/// The same polygon, beginning with its smallest corner.
Polygon from_smallest(Polygon polygon) {
    const auto less = [](const Point3& a, const Point3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    const auto smallest = std::min_element(polygon.begin(), polygon.end(), less);
    std::rotate(polygon.begin(), smallest, polygon.end());
    return polygon;
}

std::string text(const Polygon& polygon) {
    std::string corners;
    for (const Point3& p : from_smallest(polygon))
        corners += fmt::format("({} {} {}) ", p.x, p.y, p.z);
    return corners;
}

/// Four times the area of the polygon's shadow in the plane z = 0; a whole number for our polygons.
double shadow(const Polygon& polygon) {
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Double3 p(polygon[i]), q(polygon[(i + 1) % polygon.size()]);
        sum += p.x * q.y - p.y * q.x;
    }
    return 2.0 * sum;
}

const SplitPlane<3> wall({Point3(0, 0, 0), Point3(0, 2, 0), Point3(0, 0, 2)});  // front: x > 0

}  // namespace

TEST_CASE("a triangle across the plane becomes a triangle and a quadrilateral") {
    const Pieces pieces = split(Polygon{{-2, 0, 0}, {2, 0, 0}, {2, 4, 8}}, wall);
    CHECK(text(pieces.front) == text({{0, 0, 0}, {2, 0, 0}, {2, 4, 8}, {0, 2, 4}}));
    CHECK(text(pieces.back) == text({{-2, 0, 0}, {0, 0, 0}, {0, 2, 4}}));
}

TEST_CASE("a corner on the plane goes once to each piece") {
    const Pieces triangle = split(Polygon{{0, 0, 0}, {2, 4, 2}, {-2, 4, 6}}, wall);
    CHECK(text(triangle.front) == text({{0, 0, 0}, {2, 4, 2}, {0, 4, 4}}));
    CHECK(text(triangle.back) == text({{0, 0, 0}, {0, 4, 4}, {-2, 4, 6}}));

    const Pieces square = split(Polygon{{0, 0, 0}, {2, 2, 0}, {0, 4, 0}, {-2, 2, 0}}, wall);
    CHECK(text(square.front) == text({{0, 0, 0}, {2, 2, 0}, {0, 4, 0}}));
    CHECK(text(square.back) == text({{0, 0, 0}, {0, 4, 0}, {-2, 2, 0}}));
}

TEST_CASE("every polygon of some of ten corners is cut into two with its corners and area") {
    // Between two parabolas. Distances of 1 and 3 from the wall make each s a fraction of a power
    // of 2.
    Polygon ten;
    for (const float x : {-3.0f, -1.0f, 0.0f, 1.0f, 3.0f}) ten.push_back({x, x * x, 2 * x + x * x});
    for (const float x : {3.0f, 1.0f, 0.0f, -1.0f, -3.0f})
        ten.push_back({x, 20 - x * x, 2 * x + 20 - x * x});

    int cases = 0;
    for (unsigned subset = 0; subset < 1024; ++subset) {
        Polygon polygon;
        for (unsigned i = 0; i < 10; ++i)
            if (subset >> i & 1) polygon.push_back(ten[i]);
        std::size_t front = 0, back = 0, cuts = 0;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            front += polygon[i].x >= 0.0f;
            back += polygon[i].x <= 0.0f;
            cuts += polygon[i].x * polygon[(i + 1) % polygon.size()].x < 0.0f;
        }
        if (polygon.size() < 3 || front == polygon.size() || back == polygon.size()) continue;
        ++cases;

        const Pieces pieces = split(polygon, wall);
        CAPTURE(polygon, pieces.front, pieces.back);
        REQUIRE(pieces.front.size() == front + cuts);
        REQUIRE(pieces.back.size() == back + cuts);
        for (const Polygon* piece : {&pieces.front, &pieces.back}) {
            std::set<std::array<float, 3>> different;
            for (const Point3& p : *piece) {
                CAPTURE(p);
                REQUIRE((piece == &pieces.front ? p.x >= 0.0f : p.x <= 0.0f));
                REQUIRE(p.z == 2 * p.x + p.y);  // the polygons lie in this plane
                different.insert({p.x, p.y, p.z});
            }
            REQUIRE(different.size() == piece->size());
            REQUIRE(shadow(*piece) > 0.0);
        }
        REQUIRE(shadow(pieces.front) + shadow(pieces.back) == shadow(polygon));
    }
    CHECK(cases > 800);
}

TEST_CASE("a corner that is only just behind the plane is behind it") {
    for (const float off : {0x1p-10f, 0x1p-15f, 0x1p-20f}) {
        // The edges to the corner pass the wall at 1 / (1 + off) of their lengths.
        const Pieces pieces = split(Polygon{{1, 0, 0}, {1, 4, 0}, {-off, 2, 0}}, wall);
        CAPTURE(Number{off}, pieces.front, pieces.back);
        REQUIRE(pieces.front.size() == 4);
        REQUIRE(pieces.back.size() == 3);
    }
}

TEST_CASE("a cut at thirds, fifths and sevenths is right to within a rounding, on both pieces") {
    // Of triangles with one corner in front of the wall; the cuts' exact places are quotients of
    // whole numbers.
    Pcg32 random(32);
    const auto place = [&] { return static_cast<float>(random.below(2001)) - 1000.0f; };
    for (int i = 0; i < 20'000; ++i) {
        Polygon polygon(3);
        for (Point3& p : polygon)
            for (int axis = 0; axis < 3; ++axis) p[axis] = place();
        polygon[0].x = 1.0f + static_cast<float>(random.below(20));
        polygon[1].x = -1.0f - static_cast<float>(random.below(20));
        polygon[2].x = -1.0f - static_cast<float>(random.below(20));
        const Pieces pieces = split(polygon, wall);
        CAPTURE(polygon, pieces.front, pieces.back);
        REQUIRE(pieces.front.size() == 3);
        REQUIRE(pieces.back.size() == 4);
        for (const int end : {1, 2}) {
            const Double3 p(polygon[0]), q(polygon[static_cast<std::size_t>(end)]);
            const Double3 exact = (p * -q.x + q * p.x) / (p.x - q.x);
            for (const Polygon* piece : {&pieces.front, &pieces.back}) {
                Error nearest{infinity, 0.0};  // of the piece's corners
                for (const Point3& corner : *piece) {
                    const Double3 off = glm::abs(Double3(corner) - exact);
                    // Rounded once to float; the doubles before are 2^29 times finer.
                    const double size = std::max({1.0, std::abs(exact.y), std::abs(exact.z)});
                    const Error error{std::max({off.x, off.y, off.z}), 0x1.0001p-24 * size};
                    if (error.is < nearest.is) nearest = error;
                }
                CAPTURE(exact);
                REQUIRE(nearest);
            }
        }
    }
}

TEST_CASE("a slanted plane that is given by far points cuts at the same places") {
    // x + y = 4 through points of large coordinates: only the ratio of two distances counts.
    const SplitPlane<3> slanted(
        {Point3(1024, -1020, 0), Point3(-1020, 1024, 0), Point3(4, 0, 512)});
    const bool far_in_front = slanted.distance({4, 4, 0}) > 0.0;
    const auto check = [&](const Polygon& polygon, const Polygon& near, const Polygon& far) {
        const Pieces pieces = split(polygon, slanted);
        CHECK(text(far_in_front ? pieces.front : pieces.back) == text(far));
        CHECK(text(far_in_front ? pieces.back : pieces.front) == text(near));
    };
    check({{0, 0, 1}, {4, 0, 5}, {4, 4, 5}, {0, 4, 1}}, {{0, 0, 1}, {4, 0, 5}, {0, 4, 1}},
          {{4, 0, 5}, {4, 4, 5}, {0, 4, 1}});
    check({{0, 2, 0}, {8, 2, 8}, {8, 6, 8}, {0, 6, 0}}, {{0, 2, 0}, {2, 2, 2}, {0, 4, 0}},
          {{2, 2, 2}, {8, 2, 8}, {8, 6, 8}, {0, 6, 0}, {0, 4, 0}});
}
