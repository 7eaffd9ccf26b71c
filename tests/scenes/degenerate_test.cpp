// Zero area, decided exactly: against CGAL's exact predicate.
#include "common/mesh.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <limits>

namespace space {
namespace {

bool exactly_degenerate(const Triangle& triangle) {
    using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
    const auto point = [](const Point3& p) { return Point(p.x, p.y, p.z); };
    return CGAL::collinear(point(triangle.a), point(triangle.b), point(triangle.c));
}

std::size_t disagreements(const std::vector<Triangle>& triangles) {
    std::size_t count = 0;
    for (const Triangle& triangle : triangles)
        count += (count_degenerate({&triangle, 1}) == 1) != exactly_degenerate(triangle);
    return count;
}

TEST_CASE("degenerate triangles are counted as the exact predicate counts them", "[mesh]") {
    Pcg32 random(1);
    std::vector<Triangle> triangles;
    const auto integer = [&](int range) {
        return static_cast<float>(
            static_cast<int>(random.below(2 * static_cast<std::uint32_t>(range) + 1)) - range);
    };
    const auto point = [&](int range) {
        const float x = integer(range), y = integer(range), z = integer(range);
        return Point3{x, y, z};
    };
    SECTION("small integers: many are degenerate") {
        for (int i = 0; i < 20000; ++i) triangles.push_back({point(2), point(2), point(2)});
    }
    SECTION(
        "points of a line, one of them moved by one unit in the last place of one coordinate, or "
        "not") {
        for (int i = 0; i < 20000; ++i) {
            const Point3 start = point(1 << 20), way = point(1 << 10);
            Triangle triangle{start, start + way * float(random.below(64)),
                              start - way * float(random.below(64))};
            if (random.below(2)) {
                float& moved = triangle.b[static_cast<int>(random.below(3))];
                moved = std::nextafter(moved, infinity);
            }
            triangles.push_back(triangle);
        }
    }
    SECTION("coordinates over the whole range of floats") {
        for (int i = 0; i < 20000; ++i) {
            const int spread = static_cast<int>(random.below(3)) * 100 + 1;
            const auto scaled = [&] {
                const auto exponent =
                    static_cast<int>(random.below(static_cast<std::uint32_t>(spread)));
                return std::ldexp(integer(3), exponent - spread / 2);
            };
            Triangle triangle;
            for (Point3* p : {&triangle.a, &triangle.b, &triangle.c})
                for (int axis = 0; axis < 3; ++axis) (*p)[axis] = scaled();
            if (random.below(3) == 0)
                triangle.b = 2.0f * triangle.a;  // with c = 4 a: a line through the origin
            if (random.below(3) == 0) triangle.c = 4.0f * triangle.a;
            if (random.below(4) == 0) triangle.a = triangle.b;
            triangles.push_back(triangle);
        }
    }
    SECTION("the ends of the range") {
        constexpr float tiny = std::numeric_limits<float>::denorm_min(),
                        huge = std::numeric_limits<float>::max();
        const Point3 corners[] = {{0, 0, 0},          {tiny, 0, 0},          {0, tiny, 0},
                                  {huge, huge, huge}, {-huge, -huge, -huge}, {huge, -huge, tiny},
                                  {tiny, tiny, tiny}};
        for (const Point3& a : corners)
            for (const Point3& b : corners)
                for (const Point3& c : corners) triangles.push_back({a, b, c});
    }
    const std::size_t degenerate = count_degenerate(triangles);
    CHECK(degenerate > 0);
    CHECK(degenerate < triangles.size());
    CHECK(disagreements(triangles) == 0);
}

TEST_CASE("a sum that cancels in double but not exactly is not called zero", "[mesh]") {
    // The six products differ by 2^60 and more, so that the small ones vanish in a rounded sum.
    const Triangle triangle{
        {0x1p40f, 0x1p40f, 0.0f}, {0x1p-20f, 0.0f, 0.0f}, {0.0f, 0x1p-20f, 0.0f}};
    CHECK_FALSE(exactly_degenerate(triangle));
    CHECK(count_degenerate({&triangle, 1}) == 0);
    const Triangle needle{
        {0, 0, 0}, {0x1p40f, 0x1p40f, 0.0f}, {0x1p40f, std::nextafter(0x1p40f, infinity), 0.0f}};
    CHECK(count_degenerate({&needle, 1}) == 0);
}

}  // namespace
}  // namespace space
