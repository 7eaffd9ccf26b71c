#include "ex02_split_a_polygon.hpp"

#include "tests/catch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <tuple>

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

    int cases = 0, wrong_corners = 0, wrong_sides = 0, off_plane = 0, wrong_areas = 0, doubled = 0;
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
        wrong_corners += pieces.front.size() != front + cuts || pieces.back.size() != back + cuts;
        wrong_areas += shadow(pieces.front) <= 0.0 || shadow(pieces.back) <= 0.0 ||
                       shadow(pieces.front) + shadow(pieces.back) != shadow(polygon);
        for (const Polygon* piece : {&pieces.front, &pieces.back}) {
            std::set<std::array<float, 3>> different;
            for (const Point3& p : *piece) {
                wrong_sides += piece == &pieces.front ? p.x < 0.0f : p.x > 0.0f;
                off_plane += p.z != 2 * p.x + p.y;
                different.insert({p.x, p.y, p.z});
            }
            doubled += different.size() != piece->size();
        }
    }
    CHECK(cases > 800);
    CHECK(wrong_corners == 0);
    CHECK(wrong_sides == 0);
    CHECK(off_plane == 0);  // the polygons lie in z = 2x + y
    CHECK(wrong_areas == 0);
    CHECK(doubled == 0);
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
