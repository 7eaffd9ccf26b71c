// Zero area, decided exactly: against the oracle's rational numbers.
#include "common/zero_area.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/exact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace space {
namespace {

TEST_CASE("exactly the triangles whose corners lie on a line have zero area") {
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
    const auto count = std::count_if(triangles.begin(), triangles.end(), has_zero_area);
    CHECK(count > 0);
    CHECK(count < static_cast<std::ptrdiff_t>(triangles.size()));
    CHECK(std::none_of(triangles.begin(), triangles.end(), [](const Triangle& triangle) {
        return has_zero_area(triangle) != is_degenerate(triangle);
    }));
}

TEST_CASE("a sum that cancels in double but not exactly is not called zero") {
    // The six products differ by 2^60 and more, so that the small ones vanish in a rounded sum.
    CHECK_FALSE(
        has_zero_area({{0x1p40f, 0x1p40f, 0.0f}, {0x1p-20f, 0.0f, 0.0f}, {0.0f, 0x1p-20f, 0.0f}}));
    CHECK_FALSE(has_zero_area(
        {{0, 0, 0}, {0x1p40f, 0x1p40f, 0.0f}, {0x1p40f, std::nextafter(0x1p40f, infinity), 0.0f}}));
    // The same in the differences of corners.
    const float n = 0x1p23f, e = 0x1p-29f;
    CHECK_FALSE(has_zero_area({{e, 0, 0}, {n + 1, n, 0}, {-n - 1, -n, 0}}));
    CHECK(has_zero_area({{0, 0, 0}, {n + 1, n, 0}, {-n - 1, -n, 0}}));
}

TEST_CASE("corners on a line have zero area, whatever normal double computes for them") {
    Pcg32 random(14);
    int crooked = 0;
    for (int i = 0; i < 100; ++i) {
        const float x = random.uniform(-1.0f, 1.0f), y = random.uniform(-1.0f, 1.0f);
        const Point3 p(x, y, random.uniform(-1.0f, 1.0f));
        const Triangle line{-0x1p-40f * p, p, 0x1p10f * p};  // differences longer than a double
        crooked += normal(line) != Double3(0.0);
        CHECK(has_zero_area(line));
    }
    CHECK(crooked > 50);
}

}  // namespace
}  // namespace space
